/// Models, the table of their parameters, their natural modes.
#include <nanobind/stl/complex.h>

#include <complex>
#include <limits>

#include "bind.hpp"
#include "chosen.hpp"
#include "slapstick/flow/energy_sources.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/flow/natural_modes.hpp"
#include "slapstick/flow/struck_together.hpp"
#include "slapstick/section/stop_choice.hpp"

namespace slapstick::python {
namespace {

void bind_parameter(nb::module_& module) {
  nb::class_<Parameter>(module, "Parameter", "A number of a model that a keyword of the verbs sets.")
      .def_ro("name", &Parameter::name)
      .def_ro("value", &Parameter::value, "the default")
      .def_ro("expression", &Parameter::expression, "what it follows until it is set; '' for a plain number")
      .def_ro("min", &Parameter::min)
      .def_ro("max", &Parameter::max)
      .def_ro("description", &Parameter::description)
      .def_ro("unit", &Parameter::unit)
      .def_prop_ro("range", &Parameter::range, "'(0, inf)', '[0, 1]'")
      .def("admits", &Parameter::admits, "number"_a, "Whether the range holds this number.");
}

std::vector<std::string> stop_names(const ModelDefinition& definition) {
  const Model model = definition.build();
  std::vector<std::string> names;
  for (const int contact : stop_contacts(model)) names.push_back(stop_name(model, contact));
  return names;
}

nb::list natural(const System& system, const State& start) {
  nb::list all;
  for (const NaturalMode& mode : natural_modes(system, sliding_states(system, start))) {
    nb::dict entry;
    if (mode.oscillates()) {
      entry["frequency"] = mode.frequency;
      entry["damping_ratio"] = mode.damping_ratio();
    }
    entry["decay"] = mode.decay;
    all.append(entry);
  }
  return all;
}

/// What `slapstick check` prints, without the parameters and their units.
nb::dict check(const ModelDefinition& definition, const Overrides& values) {
  const Model model = build(definition, values);
  const State start = start_of(definition, values, {});
  const System system(model);
  static_cast<void>(Motion(system, start));
  nb::dict laid, result;
  for (const LaidLaw& law : definition.laid_laws(values)) laid[law.friction.c_str()] = law.largest_error;
  result["sound"] = true;
  result["name"] = model.name;
  result["coordinates"] = model.size();
  result["stops"] = model.stops.size();
  result["compliant_stops"] = model.compliant_stops.size();
  result["frictions"] = model.frictions.size();
  result["characteristics"] = model.characteristics.size();
  std::vector<std::string> rows;
  for (const int stop : struck_together(model, start)) rows.push_back(model.stops[static_cast<std::size_t>(stop)].name);
  result["impact_law"] = model.impact_law == ImpactLaw::sequence ? "sequence" : "moreau";
  if (!rows.empty()) result["struck_together"] = rows, result["note"] = how_rows_are_struck;
  result["period"] = model.forcing_period();
  result["forced"] = model.forced();
  result["feeds_energy"] = energy_sources(model);
  result["falling_forces"] = falling_forces(model);
  result["laid_errors"] = laid;
  result["natural_modes"] = natural(system, start);
  return result;
}

std::vector<NaturalMode> modes(const ModelDefinition& definition, const Overrides& values,
                               const std::optional<Start>& start, const std::vector<std::string>& stuck,
                               const std::vector<std::string>& closed) {
  const System system(build(definition, values));
  return natural_modes(system, sliding_states(system, start_of(definition, values, start), stuck, closed));
}

void bind_modes(nb::module_& module) {
  nb::class_<NaturalMode>(module, "NaturalMode", "An eigenvalue of a machine, and its shape.")
      .def_ro("frequency", &NaturalMode::frequency)
      .def_ro("decay", &NaturalMode::decay)
      .def_prop_ro("damping_ratio",
                   [](const NaturalMode& self) {
                     return self.oscillates() ? self.damping_ratio() : std::numeric_limits<double>::quiet_NaN();
                   })
      .def_prop_ro("cycles", &NaturalMode::cycles)
      .def_ro("shape", &NaturalMode::shape)
      .def_prop_ro("amplitude",
                   [](const NaturalMode& self) {
                     std::vector<double> sizes;
                     for (const std::complex<double>& part : self.shape) sizes.push_back(std::abs(part));
                     return sizes;
                   })
      .def_prop_ro("phase", [](const NaturalMode& self) {
        std::vector<double> phases;
        for (const std::complex<double>& part : self.shape) phases.push_back(std::arg(part));
        return phases;
      });
  module.def("modes", &modes, "definition"_a, "values"_a, "start"_a.none(), "stuck"_a, "closed"_a);
}

}  // namespace

void bind_model(nb::module_& module) {
  bind_parameter(module);
  bind_modes(module);
  nb::class_<ModelDefinition>(module, "Definition", "A model file that has been read and checked. Immutable.")
      .def_prop_ro("name", &ModelDefinition::name)
      .def_prop_ro("summary", &ModelDefinition::summary)
      .def_prop_ro("notes", &ModelDefinition::notes)
      .def_prop_ro("parameters", [](const ModelDefinition& self) { return std::vector<Parameter>(self.parameters()); })
      .def_prop_ro("groups",
                   [](const ModelDefinition& self) {
                     std::map<std::string, std::vector<std::string>> groups;
                     for (const Group& group : self.groups()) groups[group.name] = group.members;
                     return groups;
                   })
      .def_prop_ro("state_names", [](const ModelDefinition& self) { return state_names(self.build()); })
      .def_prop_ro("contacts", [](const ModelDefinition& self) { return contact_names(self.build()); })
      .def_prop_ro("feeds_energy", [](const ModelDefinition& self) { return energy_sources(self.build()); })
      .def_prop_ro("stops", &stop_names)
      .def_prop_ro("forced", [](const ModelDefinition& self) { return self.build().forced(); })
      .def_prop_ro("observables",
                   [](const ModelDefinition& self) {
                     std::vector<std::string> names;
                     for (const Observable& observable : self.observables()) names.push_back(observable.name);
                     return names;
                   })
      .def("values", &ModelDefinition::values, "values"_a)
      .def("check", &check, "values"_a,
           nb::sig("def check(self, values: Mapping[str, float]) -> dict[str, typing.Any]"))
      .def(
          "start", [](const ModelDefinition& self, const Overrides& values) { return start_of(self, values, {}); },
          "values"_a)
      .def(
          "period",
          [](const ModelDefinition& self, const Overrides& values) { return build(self, values).forcing_period(); },
          "values"_a)
      .def("to_toml", &ModelDefinition::to_toml, "values"_a);
  module.def("parse_model", &ModelDefinition::parse, "text"_a, "source"_a);
  module.def("load_model", &load_model, "name_or_path"_a);
  module.def("builtin_models", &builtin_models);
  module.def("new_model", &new_model, "name"_a);
}

}  // namespace slapstick::python
