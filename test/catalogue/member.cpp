#include "catalogue/member.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "flow/runs.hpp"

namespace slapstick::catalogue {
namespace {

/// "1..52" as numbers, a list as it is.
std::vector<Entry> range(const Entry& values) {
  if (values.is_array()) return values.get<std::vector<Entry>>();
  const auto text = values.get<std::string>();
  const auto dots = text.find("..");
  std::vector<Entry> all;
  for (long k = std::stol(text.substr(0, dots)); k <= std::stol(text.substr(dots + 2)); ++k) all.emplace_back(k);
  return all;
}

/// The members of "for", each {name: value}.
std::vector<Entry> members(const Entry& entry) {
  if (!entry.contains("for")) return {Entry::object()};
  const Entry& family = entry["for"];
  if (family.is_array()) return family.get<std::vector<Entry>>();
  std::vector<Entry> all = {Entry::object()};
  for (const auto& [name, values] : family.items()) {
    std::vector<Entry> longer;
    for (const Entry& member : all) {
      for (const Entry& value : range(values)) {
        longer.push_back(member);
        longer.back()[name] = value;
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::string text_of(const Entry& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

std::string with_names(std::string text, const Entry& member) {
  for (const auto& [name, value] : member.items()) {
    const std::string place = "{" + name + "}";
    for (auto at = text.find(place); at != std::string::npos; at = text.find(place))
      text.replace(at, place.size(), text_of(value));
  }
  return text;
}

Entry with_names(const Entry& entry, const Entry& member) {
  if (entry.is_string()) return with_names(entry.get<std::string>(), member);
  if (!entry.is_structured()) return entry;
  Entry all = entry.is_array() ? Entry::array() : Entry::object();
  for (const auto& [key, part] : entry.items()) {
    if (entry.is_array())
      all.push_back(with_names(part, member));
    else
      all[with_names(key, member)] = with_names(part, member);
  }
  return all;
}

/// Letters, digits and single underscores, as a test's name needs.
std::string word(const std::string& text) {
  std::string all;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (c == '-')
      all += "minus_";
    else if (plain || (!all.empty() && all.back() != '_'))
      all += plain ? c : '_';
  }
  while (!all.empty() && all.back() == '_') all.pop_back();
  return all;
}

Member make_member(const Entry& entry, const Entry& names) {
  std::string name = entry.at("id").get<std::string>() + "_" + word(entry.at("title").get<std::string>());
  Member member{"", with_names(entry, names), {{"campaign", static_cast<double>(testing::campaign())}}};
  for (const auto& [key, value] : names.items()) {
    const std::string text = text_of(value);
    if (text.size() < 24) name += "_" + word(key) + "_" + word(text);
    const Entry texts = entry.value("texts", Entry::array());
    if (std::ranges::find(texts, Entry(key)) == texts.end()) member.given[key] = library::number(value, member.given);
  }
  const Entry let = member.entry.value("let", Entry::object());
  for (const auto& [key, value] : let.items()) member.given[key] = library::number(value, member.given);
  member.name = name;
  return member;
}

}  // namespace

const std::vector<Member>& all_members() {
  static const auto all = [] {
    std::vector<Member> found;
    std::set<std::string> names;
    for (const Entry& entry : library::read_entries(std::string(SLAPSTICK_CATALOGUE) + "catalogue.json")) {
      for (const Entry& member : members(entry)) {
        found.push_back(make_member(entry, member));
        if (!names.insert(found.back().name).second) throw std::invalid_argument(found.back().name + " stands twice");
      }
    }
    return found;
  }();
  return all;
}

}  // namespace slapstick::catalogue
