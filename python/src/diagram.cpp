/// Bifurcation diagrams: the impacts of the attractor at many values of a parameter, as columns.
#include <nanobind/stl/tuple.h>

#include <cmath>
#include <memory>

#include "arrays.hpp"
#include "bind.hpp"
#include "chosen.hpp"
#include "names.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/measure.hpp"
#include "slapstick/sweep/diagram.hpp"
#include "watch.hpp"

namespace slapstick::python {
namespace {

/// All rows of all values. `point` says which value a row belongs to.
struct Diagram {
  std::vector<double> parameter, w, flight, sliding, phase, state;
  std::vector<std::int32_t> point;
  Words direction{{"up", "down"}, {}}, contact;
  std::size_t width = 0;
  bool complete = true;
  std::vector<double> values;           ///< of the parameter, at each point that is done
  std::vector<std::string> directions;  ///< of each
  std::vector<std::tuple<double, std::string>> failures, notes, empty;
  /// Of measured quantities: the values that did not fail, the direction of each (0: up), and a column for each
  /// statistic.
  std::vector<double> measured_at;
  std::vector<std::int32_t> measured_direction;
  std::vector<std::vector<double>> measured;
};

/// What is shown in place of impacts: quantities, and of each a statistic, or no statistics: values at instants.
struct Measure {
  std::vector<Quantity> of;
  std::vector<std::string> statistics;
  int periods = 0;
  std::string at;  ///< sweep::parse_instants
  [[nodiscard]] bool reads() const { return !of.empty() && statistics.empty(); }
};

void add_measured(Diagram& into, const sweep::DiagramPoint& point, double value, const Measure& measure) {
  const std::size_t columns = measure.of.size();
  const auto begin_row = [&] {
    into.measured_at.push_back(value);
    into.measured_direction.push_back(point.direction == sweep::Direction::up ? 0 : 1);
  };
  if (!point.of.empty()) begin_row();
  for (std::size_t k = 0; k < point.of.size(); ++k)
    into.measured[k].push_back(statistic(point.of[k], measure.statistics[k]));
  for (std::size_t i = 0; i < point.values.size(); ++i) {
    if (i % columns == 0) begin_row();
    into.measured[i % columns].push_back(point.values[i]);
  }
}

void add_rows(Diagram& into, const sweep::DiagramPoint& point, double value, std::int32_t index) {
  for (std::size_t i = 0; i < point.impacts.size(); ++i) {
    const sweep::ImpactTable::Row row = point.impacts[i];
    into.parameter.push_back(value);
    into.point.push_back(index);
    into.direction.codes.push_back(point.direction == sweep::Direction::up ? 0 : 1);
    into.w.push_back(row.w);
    into.flight.push_back(row.flight);
    into.sliding.push_back(row.sliding);
    into.phase.push_back(row.phase);
    into.contact.codes.push_back(row.contact);
    into.state.insert(into.state.end(), row.state.begin(), row.state.end());
  }
}

/// What the sweep gave, value by value. @param value_of  of a point's place in the sweep
template <class ValueOf>
void add_points(Diagram& into, const sweep::Diagram& found, const Measure& measure, const ValueOf& value_of) {
  for (const sweep::DiagramPoint& point : found.points) {
    if (!point.done) continue;
    const double value = value_of(point.parameter);
    const std::string direction = point.direction == sweep::Direction::up ? "up" : "down";
    add_rows(into, point, value, static_cast<std::int32_t>(into.values.size()));
    add_measured(into, point, value, measure);
    into.values.push_back(value);
    into.directions.push_back(direction);
    if (!point.failure.empty()) into.failures.emplace_back(value, point.failure);
    if (!point.note.empty()) into.notes.emplace_back(value, point.note);
    const bool rows = measure.reads() ? !point.values.empty() : !measure.of.empty() || point.impacts.size() > 0;
    if (point.failure.empty() && !rows) into.empty.emplace_back(value, direction);
  }
}

sweep::Direction direction_of(const std::string& name) {
  if (name == "up") return sweep::Direction::up;
  if (name == "down") return sweep::Direction::down;
  if (name == "both") return sweep::Direction::both;
  throw InputError("direction: '" + name + "' is none of up, down, both");
}

sweep::StartRule rule_of(const std::string& name) {
  if (name == "carry") return sweep::StartRule::carry;
  if (name == "reset") return sweep::StartRule::reset;
  throw InputError("rule: '" + name + "' is none of carry, reset");
}

struct Wish {
  std::string direction, rule;
  std::optional<double> transient;
  int impacts, most_periods;
  std::vector<std::string> stops;
  int threads;
};

/// A sweep over the places 0 .. count - 1 of a list of increasing values. Places come back with rounding.
class Sweep {
 public:
  Sweep(const ModelDefinition& definition, Overrides fixed, std::string name, std::vector<double> values,
        std::optional<Start> start)
      : definition_(definition),
        fixed_(std::move(fixed)),
        name_(std::move(name)),
        values_(std::move(values)),
        start_(std::move(start)) {}

  [[nodiscard]] double value(double place) const { return values_[static_cast<std::size_t>(std::lround(place))]; }

  [[nodiscard]] sweep::DiagramProblem problem(const Wish& wish) const {
    sweep::DiagramProblem problem;
    problem.model_at = [this](double place) { return build(definition_, at(place)); };
    problem.start_at = [this](double place) { return start_of(definition_, at(place), start_); };
    problem.from = 0.0;
    problem.to = static_cast<double>(values_.size() - 1);
    problem.count = static_cast<int>(values_.size());
    problem.transient_periods = wish.transient;
    problem.impacts = wish.impacts;
    problem.most_periods = wish.most_periods;
    problem.direction = direction_of(wish.direction);
    problem.start = rule_of(wish.rule);
    problem.threads = wish.threads;
    return problem;
  }

  /// What can be known to be wrong before the work. @returns the model at the first value
  [[nodiscard]] Model check(bool impacts) const {
    for (const double end : {problem_end(), 0.0}) static_cast<void>(start_of(definition_, at(end), start_));
    Model model = build(definition_, at(0.0));
    if (impacts && stop_contacts(model).empty())
      throw InputError("model '" + model.name + "' has no stop, so a diagram has no impacts to show");
    return model;
  }

 private:
  [[nodiscard]] double problem_end() const { return static_cast<double>(values_.size() - 1); }
  [[nodiscard]] Overrides at(double place) const {
    Overrides all = fixed_;
    all[name_] = value(place);
    return all;
  }

  const ModelDefinition& definition_;
  Overrides fixed_;
  std::string name_;
  std::vector<double> values_;
  std::optional<Start> start_;
};

/// Values at instants. @throws InputError naming `at` or `y`
void read_at(const Measure& measure, const Model& model, sweep::DiagramProblem& problem) {
  const std::string* argument = nullptr;
  const std::string at = "at: ", y = "y: ";
  try {
    argument = &at;
    const sweep::InstantChoice instants = sweep::parse_instants(measure.at, System(model));
    argument = &y;
    for (const Quantity& quantity : measure.of) sweep::check_value_at(quantity, instants.read_at);
    problem.values_of = measure.of;
    problem.read_at = instants.read_at;
    problem.event = instants.event;
  } catch (const InputError& error) {
    throw InputError(*argument + error.what());
  }
}

std::unique_ptr<Diagram> diagram(const ModelDefinition& definition, const Overrides& fixed, const std::string& name,
                                 const std::vector<double>& values, const std::optional<Start>& start,
                                 const std::string& direction, const std::string& rule, std::optional<double> transient,
                                 int impacts, int most_periods, const std::vector<std::string>& stops, int threads,
                                 const Measure& measure, nb::object progress) {
  auto into = std::make_unique<Diagram>();
  into->measured.resize(measure.of.size());
  for (std::size_t k = 0; k < measure.statistics.size(); ++k)
    check_statistic_of_stretch(measure.of[k], measure.statistics[k]);
  const Sweep sweep(definition, fixed, name, values, start);
  const Model model = sweep.check(measure.of.empty());
  sweep::DiagramProblem problem = sweep.problem({direction, rule, transient, impacts, most_periods, stops, threads});
  problem.stops = StopChoice(model, stops);
  measure.reads() ? read_at(measure, model, problem) : static_cast<void>(problem.of = measure.of);
  problem.measured_periods = measure.periods;
  Watch watch(std::move(progress));
  problem.cancel = watch.cancel();
  problem.progress = [&](int done, int) { watch.note(done); };
  watch.run_aside([&] {
    const sweep::Diagram found = sweep::run_diagram(problem);
    into->width = 2 * static_cast<std::size_t>(model.size());
    into->contact.names = contact_names(model);
    add_points(*into, found, measure, [&](double place) { return sweep.value(place); });
  });
  into->complete = watch.finish(true);
  return into;
}

}  // namespace

void bind_diagram(nb::module_& module) {
  nb::class_<Diagram>(module, "Diagram", "The impacts at many values of a parameter.")
      .def_prop_ro("parameter", [](Diagram& self) { return column(self.parameter); })
      .def_prop_ro("w", [](Diagram& self) { return column(self.w); })
      .def_prop_ro("flight", [](Diagram& self) { return column(self.flight); })
      .def_prop_ro("sliding", [](Diagram& self) { return column(self.sliding); })
      .def_prop_ro("phase", [](Diagram& self) { return column(self.phase); })
      .def_prop_ro("state", [](Diagram& self) { return transposed(self.state, self.width); })
      .def_prop_ro("point", [](Diagram& self) { return column(self.point); })
      .def_prop_ro("direction_codes", [](Diagram& self) { return column(self.direction.codes); })
      .def_prop_ro("contact_codes", [](Diagram& self) { return column(self.contact.codes); })
      .def_prop_ro("contact_names", [](const Diagram& self) { return self.contact.names; })
      .def_prop_ro("values", [](Diagram& self) { return column(self.values); })
      .def_ro("directions", &Diagram::directions)
      .def_ro("failures", &Diagram::failures)
      .def_ro("notes", &Diagram::notes)
      .def_ro("empty", &Diagram::empty)
      .def_prop_ro("measured_at", [](Diagram& self) { return column(self.measured_at); })
      .def_prop_ro("measured_direction_codes", [](Diagram& self) { return column(self.measured_direction); })
      .def(
          "measured", [](Diagram& self, std::size_t k) { return column(self.measured.at(k)); }, "k"_a)
      .def_ro("complete", &Diagram::complete);
  nb::class_<Measure>(module, "DiagramMeasure", "What a diagram shows in place of impacts.")
      .def(
          "__init__",
          [](Measure* self, std::vector<Quantity> of, std::vector<std::string> statistics, int periods,
             std::string at) {
            new (self) Measure{std::move(of), std::move(statistics), periods, std::move(at)};
          },
          "of"_a, "statistics"_a, "periods"_a, "at"_a);
  module.def("diagram", &diagram, "definition"_a, "fixed"_a, "name"_a, "values"_a, "start"_a.none(), "direction"_a,
             "rule"_a, "transient"_a.none(), "impacts"_a, "most_periods"_a, "stops"_a, "threads"_a, "measure"_a,
             "progress"_a.none());
  module.def("sweep_value", &sweep::sweep_value, "begin"_a, "end"_a, "count"_a, "place"_a);
}

}  // namespace slapstick::python
