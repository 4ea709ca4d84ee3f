/// slapstick models
#include "output.hpp"
#include "io/json.hpp"
#include "slapstick/io/model_file.hpp"
#include "verb.hpp"

namespace slapstick::app {

Action add_models(Arguments& arguments) {
  arguments.footer("Prints JSON: name and summary of each model. `slapstick show NAME` prints one as a model file.");
  return [](const Context&) {
    Json list = Json::list();
    for (const std::string& name : builtin_models()) {
      Json entry = Json::object();
      entry.set("name", name).set("summary", load_model(name).summary());
      list.push(std::move(entry));
    }
    Output out("");
    out.write(list.dump() + "\n");
    out.commit();
    return done;
  };
}

}  // namespace slapstick::app
