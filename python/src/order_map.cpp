/// Lines of a quantity over a run-up, as columns.
#include "slapstick/quantity/order_map.hpp"

#include <memory>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "slapstick/quantity/quantity.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

std::unique_ptr<OrderMap> order_map_of(const ModelDefinition& definition, const Overrides& values,
                                       const std::optional<Start>& start, const std::string& of,
                                       const std::string& parameter, double from, double to, long over, long hold,
                                       long settle, double orders, nb::object progress) {
  auto result = std::make_unique<OrderMap>();
  const Quantity quantity = find_quantity(quantities(definition, values), of);
  RunUp run(
      [&](double value) {
        Overrides all = values;
        all[parameter] = value;
        return build(definition, all);
      },
      {from, to, over / hold, hold}, start_of(definition, values, start));
  Watch watch(std::move(progress));
  watch.run_aside([&] {
    *result =
        order_map(run, quantity,
                  {orders, settle, watch.cancel(), [&](long steps) { watch.note(static_cast<double>(steps * hold)); }});
  });
  watch.finish(result->complete);
  return result;
}

}  // namespace

void bind_order_map(nb::module_& module) {
  nb::class_<OrderMap>(module, "OrderMap", "The lines of a quantity at each value of a run-up.")
      .def_prop_ro("value", [](OrderMap& self) { return column(self.value); })
      .def_prop_ro("time", [](OrderMap& self) { return column(self.time); })
      .def_prop_ro("period", [](OrderMap& self) { return column(self.period); })
      .def_prop_ro("order", [](OrderMap& self) { return column(self.order); })
      .def_prop_ro("amplitude", [](OrderMap& self) { return transposed(self.amplitude, self.order.size()); });
  module.def("order_map", &order_map_of, "definition"_a, "values"_a, "start"_a.none(), "of"_a, "parameter"_a, "begin"_a,
             "end"_a, "over"_a, "hold"_a, "settle"_a, "orders"_a, "progress"_a.none());
}

}  // namespace slapstick::python
