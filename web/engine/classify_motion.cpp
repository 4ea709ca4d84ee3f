/// Says what a motion is, as `slapstick classify` does.
#include "analysis.hpp"
#include "slapstick/attractor/classify.hpp"

namespace slapstick::web {

Json classify_motion(const Choice& choice, int periods) {
  ClassifyOptions options;
  options.transient_periods = periods / 8;
  options.most_periods = periods;
  options.exponent_periods = periods;
  const Classification found = classify(System(choice.model()), choice.start_at(), options);
  Json json = Json::object();
  json.set("label", found.label).set("attractor", std::string(name(found.attractor)));
  json.set("n", found.n).set("p", static_cast<std::int64_t>(found.p)).set("chatter", std::string(name(found.chatter)));
  return json.set("sticking", found.sticking).set("exponent", found.exponent);
}

}  // namespace slapstick::web
