/// Gathers what the verbs declare, and writes it as JSON and as a page.
#include "catalogue.hpp"

#include "io/json.hpp"
#include "slapstick/quantity/measure.hpp"
#include "verb.hpp"

namespace slapstick::app {

std::vector<VerbFacts> catalogue() {
  std::vector<VerbFacts> all;
  for (const Verb& verb : verbs()) {
    Arguments arguments(verb.name, verb.summary);
    (void)verb.add(arguments);
    all.push_back({verb.name, verb.summary, arguments.notes(), arguments.facts()});
  }
  return all;
}

namespace {

Json words_json(const std::vector<std::string>& words) {
  Json list = Json::list();
  for (const std::string& word : words) list.push(word);
  return list;
}

Json fact_json(const ArgumentFact& fact) {
  Json json = Json::object();
  json.set("name", fact.name).set("kind", std::string(name(fact.kind)));
  if (!fact.value.empty()) json.set("value", fact.value);
  if (fact.kind == ArgumentFact::Kind::choice) json.set("words", words_json(fact.words));
  if (fact.kind == ArgumentFact::Kind::count) json.set("least", fact.least).set("most", fact.most);
  if (!fact.range.all()) json.set("range", fact.range.text());
  if (fact.required) json.set("required", true);
  Json with = Json::list();
  for (const std::vector<std::string>& one_of : fact.with) with.push(words_json(one_of));
  if (!fact.with.empty()) json.set("with", std::move(with));
  if (!fact.without.empty()) json.set("without", words_json(fact.without));
  return json.set("help", fact.help);
}

Json quantities_json() {
  Json list = Json::list();
  for (const QuantityRule& rule : quantity_rules()) {
    Json one = Json::object();
    one.set("of", std::string(name(rule.of)))
        .set("name", std::string(rule.name))
        .set("kind", std::string(name(rule.kind)));
    list.push(one.set("meaning", std::string(rule.meaning)));
  }
  return list;
}

Json statistics_json() {
  Json list = Json::list();
  for (const StatisticRule& rule : statistic_rules())
    list.push(Json::object().set("name", std::string(rule.name)).set("meaning", std::string(rule.meaning)));
  return list;
}

/// A cell of a table: bars would end it.
std::string cell(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? std::string("\\|") : std::string(1, c == '\n' ? ' ' : c);
  return safe;
}

std::string row(const std::string& first, const std::string& second) {
  return "| `" + cell(first) + "` | " + cell(second) + " |\n";
}

}  // namespace

std::string catalogue_json() {
  Json list = Json::list();
  for (const VerbFacts& verb : catalogue()) {
    Json one = Json::object(), arguments = Json::list();
    for (const ArgumentFact& fact : verb.arguments) arguments.push(fact_json(fact));
    one.set("name", verb.name).set("summary", verb.summary).set("arguments", std::move(arguments));
    list.push(one.set("notes", verb.notes));
  }
  Json models = Json::list();
  for (const std::string& model : builtin_models()) models.push(model);
  Json json = Json::object();
  json.set("program", "slapstick").set("version", SLAPSTICK_VERSION).set("verbs", std::move(list));
  json.set("quantities", quantities_json()).set("statistics", statistics_json()).set("models", std::move(models));
  return json.dump() + "\n";
}

std::string catalogue_markdown() {
  std::string text =
      "# All options\n\nThis page is `slapstick describe --markdown`: the program writes it from what its verbs "
      "declare.\n"
      "[command_line.md](command_line.md) explains the verbs, [measure.md](measure.md) the quantities.\n";
  for (const VerbFacts& verb : catalogue()) {
    text += "\n## " + verb.name + "\n\n" + verb.summary + "\n";
    if (!verb.arguments.empty()) text += "\n| | |\n|---|---|\n";
    for (const ArgumentFact& fact : verb.arguments)
      text += row(fact.name + (fact.value.empty() ? "" : " " + fact.value), fact.described());
  }
  text += "\n## Quantities\n\n| of a | name | |\n|---|---|---|\n";
  for (const QuantityRule& rule : quantity_rules())
    text += "| " + std::string(name(rule.of)) + " | `" + std::string(rule.name) + "` | " +
            cell(std::string(rule.meaning)) + " |\n";
  text += "\n## Statistics\n\n| | |\n|---|---|\n";
  for (const StatisticRule& rule : statistic_rules()) text += row(std::string(rule.name), std::string(rule.meaning));
  return text;
}

}  // namespace slapstick::app
