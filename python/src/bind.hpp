#pragma once
/// The parts of the extension module: one function and one source for each topic.
#include <nanobind/nanobind.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

namespace slapstick::python {

namespace nb = nanobind;
using namespace nb::literals;

void bind_errors(nb::module_& module);
void bind_model(nb::module_& module);
void bind_motion(nb::module_& module);
void bind_attractor(nb::module_& module);
void bind_lyapunov(nb::module_& module);
void bind_section(nb::module_& module);
void bind_diagram(nb::module_& module);
void bind_orbit(nb::module_& module);
void bind_branch(nb::module_& module);
void bind_locus(nb::module_& module);
void bind_map(nb::module_& module);
void bind_basins(nb::module_& module);
void bind_batch(nb::module_& module);
void bind_quantity(nb::module_& module);
void bind_order_map(nb::module_& module);
void bind_certificate(nb::module_& module);

}  // namespace slapstick::python
