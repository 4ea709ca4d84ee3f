/// Writes the spectrum of a quantity, as `slapstick spectrum` computes it.
#include "analysis.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/span.hpp"

namespace slapstick::web {

Json spectrum_of(const Choice& choice, const std::string& quantity, double highest_order) {
  const System system(choice.model());
  const Quantity of = quantities_of(choice, quantity).at(0);
  const std::optional<Span> span = find_span(choice.definition, choice.set, system, choice.start_at(), {});
  if (!span) throw NumericalError("stopped");
  std::vector<double> order, height;
  if (span->cycle) {
    for (const SpectralLine& line : spectrum(*span->problem, span->cycle->orbit, of, highest_order).lines) {
      order.push_back(line.order);
      height.push_back(line.amplitude());
    }
  } else {
    const DensitySpectrum found = density(*span, of, {.highest_order = highest_order});
    order = found.order, height = found.density;
  }
  Json json = Json::object();
  json.set("kind", span->cycle ? "lines" : "density").set("label", span->cycle ? span->cycle->label : "");
  return json.set("order", Json::list(order)).set("height", Json::list(height));
}

}  // namespace slapstick::web
