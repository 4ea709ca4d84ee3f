/// slapstick quantities MODEL
#include "io/json.hpp"
#include "model_options.hpp"
#include "output.hpp"
#include "slapstick/quantity/quantity.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

struct Options {
  ModelOptions model;
  std::string out;
};

int run(const Options& options) {
  FileRoles roles;
  roles.add("MODEL", options.model.source);
  roles.add("--out", options.out);
  Output out(options.out);
  const ChosenModel chosen = options.model.load();
  Json list = Json::list();
  for (const Quantity& one : quantities(chosen.definition, chosen.overrides)) {
    Json item = Json::object();
    item.set("name", one.name)
        .set("unit", one.unit)
        .set("kind", std::string(name(one.kind)))
        .set("meaning", one.meaning);
    list.push(std::move(item));
  }
  out.write(list.dump() + "\n");
  out.commit();
  return done;
}

}  // namespace

Action add_quantities(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->model.declare(arguments);
  arguments.text("--out", options->out, "FILE", "write the JSON there instead of to standard output");
  arguments.footer(
      "What `measure` and `spectrum` can measure on a model: names, units and meanings. docs/reference/measure.md "
      "defines them.\n"
      "  slapstick quantities vibro-impact");
  return [options](const Context&) { return run(*options); };
}

}  // namespace slapstick::app
