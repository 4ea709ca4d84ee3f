/// Says what a motion is, as `slapstick classify` does.
#include "analysis.hpp"
#include "slapstick/attractor/classify.hpp"

namespace slapstick::web {
namespace {

Json pairs(const std::vector<std::complex<double>>& numbers) {
  Json list = Json::list();
  for (const auto& z : numbers) list.push(Json::list({z.real(), z.imag()}));
  return list;
}

}  // namespace

Json classify_motion(const Choice& choice, int periods) {
  ClassifyOptions options;
  options.transient_periods = periods / 8;
  options.most_periods = periods;
  options.exponent_periods = periods;
  const Classification found = classify(System(choice.model()), choice.start_at(), options);
  Json json = Json::object();
  json.set("label", found.label).set("attractor", std::string(name(found.attractor)));
  json.set("n", found.n).set("p", static_cast<std::int64_t>(found.p)).set("chatter", std::string(name(found.chatter)));
  json.set("sticking", found.sticking).set("stickingFraction", found.sticking_fraction);
  json.set("exponent", found.exponent).set("exponentError", found.exponent_error);
  json.set("multipliers", pairs(found.multipliers)).set("periods", static_cast<std::int64_t>(found.periods_used));
  return json.set("state", Json::list(found.state));
}

}  // namespace slapstick::web
