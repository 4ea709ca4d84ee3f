/// The extension module slapstick._core: the library's functions over numpy arrays. The module converts, and computes
/// nothing.
#include "bind.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::python {

void bind_errors(nb::module_& module) {
  nb::exception<InputError>(module, "InputError", PyExc_ValueError).doc() =
      "The caller's mistake. One line names the argument, or the file, line and key.";
  nb::exception<NumericalError>(module, "NumericalError", PyExc_ArithmeticError).doc() =
      "A computation that did not succeed. One line says what, where and what to try.";
  nb::exception<StorageError>(module, "StorageError", PyExc_OSError).doc() =
      "A file that could not be read or written.";
}

}  // namespace slapstick::python

NB_MODULE(_core, module) {
  using namespace slapstick::python;
  module.doc() = "The library of slapstick over numpy arrays. The package slapstick is what users call.";
  module.attr("version") = SLAPSTICK_VERSION;
  bind_errors(module);
  bind_model(module);
  bind_motion(module);
  bind_attractor(module);
  bind_lyapunov(module);
  bind_section(module);
  bind_diagram(module);
  bind_orbit(module);
  bind_branch(module);
  bind_locus(module);
  bind_map(module);
  bind_basins(module);
  bind_batch(module);
  bind_quantity(module);
  bind_order_map(module);
  bind_certificate(module);
}
