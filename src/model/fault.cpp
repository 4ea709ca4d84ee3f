/// Finds what is wrong with a model's parts.
#include "model/fault.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "base/text.hpp"

namespace slapstick {
namespace {

using Found = std::optional<Fault>;

/// Column names of tables, and the word for the surroundings: a coordinate of that name would be ambiguous.
constexpr std::array<std::string_view, 9> reserved = {"ground", "time",   "kind",  "contact", "w",
                                                      "mode",   "flight", "phase", "omega"};

bool has_plain_name(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  if (name.empty() || name.size() > 64 || !letter(name.front())) return false;
  for (const char c : name)
    if (!letter(c) && !(c >= '0' && c <= '9')) return false;
  return true;
}

std::string assigned(std::string_view field, double value) { return std::string(field) + " = " + shown(value); }

/// Checks of one part, each remembering only the first thing that is wrong.
class Check {
 public:
  Check(const char* part, int index) : part_(part), index_(index) {}

  void fail(std::string field, std::string what) {
    if (!found_) found_ = Fault{part_, index_, std::move(field), std::move(what)};
  }
  void finite(const char* field, double value) {
    if (!std::isfinite(value)) fail(field, assigned(field, value) + " is not a finite number");
  }
  /// Finite and not so large that products overflow.
  void sized(const char* field, double value) {
    finite(field, value);
    if (std::abs(value) > largest)
      fail(field, assigned(field, value) + " is too large: beyond 1e50 the arithmetic would overflow");
  }
  void positive(const char* field, double value) {
    sized(field, value);
    if (!(value > 0.0)) fail(field, assigned(field, value) + " is not positive");
    if (value < smallest)
      fail(field, assigned(field, value) + " is too small: below 1e-50 the arithmetic would overflow");
  }
  void not_negative(const char* field, double value) {
    sized(field, value);
    if (!(value >= 0.0)) fail(field, assigned(field, value) + " is negative");
  }
  void end(const char* field, int index, const Model& model) {
    if (index == ground || (index >= 0 && index < model.size())) return;
    fail(field,
         "coordinate index " + std::to_string(index) + " is outside [0, " + std::to_string(model.size() - 1) + "]");
  }
  void ends(int a, int b, const Model& model) {
    end("between", a, model);
    end("between", b, model);
    if (a == b) fail("between", "both ends are " + (a == ground ? "the ground" : in_quotes(name_of(a, model))));
  }
  [[nodiscard]] const Found& result() const { return found_; }

 private:
  static std::string name_of(int index, const Model& model) {
    return index >= 0 && index < model.size() ? model.coordinates[static_cast<std::size_t>(index)].name
                                              : std::to_string(index);
  }
  const char* part_;
  int index_;
  Found found_;
};

/// A name that is usable in tables and on the command line and was not used before.
void check_name(Check& check, const std::string& name, std::set<std::string>& used) {
  if (name.empty()) check.fail("name", "the name is empty");
  if (!has_plain_name(name))
    check.fail("name", "name " + in_quotes(name) + " is not 1 to 64 letters, digits and '_', beginning with a letter");
  if (!used.insert(name).second) check.fail("name", "name " + in_quotes(name) + " is used twice");
}

/// @param massive  whether the mass matrix may hold what the coordinate's own mass lacks; or it needs none
Found check_coordinate(const Coordinate& coordinate, int index, bool massive, std::set<std::string>& used) {
  Check check("coordinate", index);
  if (is_reserved(coordinate.name)) check.fail("name", "name " + in_quotes(coordinate.name) + " is reserved");
  check_name(check, coordinate.name, used);
  const auto velocity = velocity_name(coordinate.name);
  if (!used.insert(velocity).second)
    check.fail("name", "its velocity's name " + in_quotes(velocity) + " is used twice");
  if (massive)
    check.not_negative("mass", coordinate.mass);
  else
    check.positive("mass", coordinate.mass);
  return check.result();
}

Found check_spring(const Spring& spring, int index, const Model& model, std::set<std::string>& used) {
  Check check("spring", index);
  if (!spring.name.empty()) check_name(check, spring.name, used);
  check.ends(spring.a, spring.b, model);
  check.sized("stiffness", spring.stiffness);
  return check.result();
}

Found check_damper(const Damper& damper, int index, const Model& model, std::set<std::string>& used) {
  Check check("damper", index);
  if (!damper.name.empty()) check_name(check, damper.name, used);
  check.ends(damper.a, damper.b, model);
  check.sized("coefficient", damper.coefficient);
  if (damper.coefficient < 0.0 && !damper.feeds)
    check.fail("coefficient", assigned("coefficient", damper.coefficient) +
                                  " is negative; a damper that may feed energy says feeds = true");
  return check.result();
}

Found check_force(const Force& force, int index, const Model& model) {
  Check check("force", index);
  if (force.presses < 0) check.end("on", force.coordinate, model);
  if (force.presses < 0 && force.coordinate == ground)
    check.fail("on", "a force acts on a coordinate, not on the ground");
  if (force.harmonic < 0) check.fail("harmonic", "harmonic = " + std::to_string(force.harmonic) + " is negative");
  check.sized("amplitude", force.amplitude);
  check.finite("phase", force.phase);
  if (force.frequency != 0.0) check.positive("frequency", force.frequency);
  const bool timed = force.frequency != 0.0 || force.signal >= 0;
  if (timed && force.harmonic != 0) check.fail("harmonic", "a force with a frequency or a signal has harmonic 0");
  if (force.frequency != 0.0 && force.signal >= 0)
    check.fail("signal", "a force has a frequency or a signal, not both");
  if (force.signal >= static_cast<int>(model.signals.size()))
    check.fail("signal", "there is no signal " + std::to_string(force.signal));
  else if (force.signal >= 0 && force.rate && steps(model.signals[static_cast<std::size_t>(force.signal)]))
    check.fail("signal", "signal " + in_quotes(model.signals[static_cast<std::size_t>(force.signal)].name) +
                             " has a step, at which its rate of change is not finite: no damper can stand on a base "
                             "that moves by it; write a ramp");
  else if (force.signal >= 0 && force.rate && pulses(model.signals[static_cast<std::size_t>(force.signal)]))
    check.fail("signal", "signal " + in_quotes(model.signals[static_cast<std::size_t>(force.signal)].name) +
                             " has a pulse, of which there is no rate of change");
  return check.result();
}

Found check_signal(const Signal& signal, int index, double period, std::set<std::string>& used) {
  Check check("signal", index);
  if (!signal.kinematic) check_name(check, signal.name, used);  // the second derivative of another has its name and ''
  const auto& knots = signal.knots;
  if (knots.size() < 2) check.fail("points", "there are fewer than two points");
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const std::string point = "point " + std::to_string(i + 1);
    check.sized((point + ": time").c_str(), knots[i].time);
    check.sized((point + ": value").c_str(), knots[i].value);
    check.sized((point + ": pulse").c_str(), knots[i].pulse);
    const bool at_end = signal.repeats && (i == 0 || i + 1 == knots.size());
    const auto shares_time = [&](std::size_t other) {
      return other < knots.size() && knots[other].time == knots[i].time;
    };
    if (knots[i].pulse != 0.0 && (at_end || shares_time(i - 1) || shares_time(i + 1)))
      check.fail("points", point + " has a pulse, and must be neither a step nor the end of a round");
    if (i > 0 && knots[i].time < knots[i - 1].time)
      check.fail("points", point + ": time " + shown(knots[i].time) + " is below " + shown(knots[i - 1].time) +
                               " of the point before");
    if (i > 1 && knots[i].time == knots[i - 2].time)
      check.fail("points", point + ": there are three points at time " + shown(knots[i].time) + "; a step has two");
  }
  if (knots.size() > 1 && !(knots.back().time > knots.front().time)) check.fail("points", "all points are at one time");
  if (signal.in_periods && !signal.repeats) check.fail("in_periods", "a signal in periods repeats (repeats = true)");
  if (signal.in_periods && knots.size() > 1 && std::abs(knots.back().time - knots.front().time - 1.0) > 0x1p-50)
    check.fail("in_periods", "from the first to the last point there are " +
                                 shown(knots.back().time - knots.front().time) + " forcing periods, not 1");
  constexpr double longest_line = 0.96875;  // periods; of a longer one an orbit mistakes one end for the other
  for (std::size_t i = 1; signal.in_periods && i < knots.size(); ++i)
    if (knots[i].time - knots[i - 1].time > longest_line)
      check.fail("points", "point " + std::to_string(i + 1) + " is " + shown(knots[i].time - knots[i - 1].time) +
                               " forcing periods after the one before, more than 31/32: put a point between them");
  if (const auto steep = first_steep_piece(signal, signal.in_periods ? 1.0 : period))
    check.fail("points", "point " + std::to_string(steep->end + 1) + ": " + steep->what);
  return check.result();
}

void check_normal(Check& check, const NormalForce& normal, int friction, const Model& model) {
  check.sized("normal_force", normal.constant);
  for (const NormalForce::Term& term : normal.terms) {
    check.end("normal_force", term.coordinate, model);
    if (term.coordinate == ground) check.fail("normal_force", "the ground does not move");
    check.sized("normal_force", term.stiffness);
    check.sized("normal_force", term.damping);
  }
  if (normal.compliant_stop >= static_cast<int>(model.compliant_stops.size()))
    check.fail("normal_force", "there is no compliant stop " + std::to_string(normal.compliant_stop));
  if (normal.terms.empty() && normal.compliant_stop < 0 && !model.is_pressed(friction))
    check.fail("normal_force", "the force is constant: multiply static and kinetic by the constant instead");
}

Found check_friction(const FrictionContact& friction, int index, const Model& model, std::set<std::string>& used) {
  Check check("friction", index);
  check_name(check, friction.name, used);
  check.ends(friction.a, friction.b, model);
  check.sized("belt_speed", friction.belt_speed);
  check.not_negative("static", friction.static_friction);
  check.not_negative("kinetic", friction.kinetic_friction);
  if (friction.kinetic_friction > friction.static_friction)
    check.fail("kinetic", assigned("kinetic", friction.kinetic_friction) + " exceeds " +
                              assigned("static", friction.static_friction));
  if (friction.normal) check_normal(check, *friction.normal, index, model);
  return check.result();
}

Found check_stop(const Stop& stop, int index, const Model& model, std::set<std::string>& used) {
  Check check("stop", index);
  check_name(check, stop.name, used);
  check.ends(stop.a, stop.b, model);
  check.sized("clearance", stop.clearance);
  check.finite("restitution", stop.restitution);
  if (!(stop.restitution >= 0.0 && stop.restitution <= 1.0))
    check.fail("restitution", assigned("restitution", stop.restitution) + " is outside [0, 1]");
  for (std::size_t i = 0; i < stop.corners.size(); ++i) {
    const auto& [speed, restitution] = stop.corners[i];
    const std::string point = "point " + std::to_string(i + 1) + ": ";
    check.positive((point + "speed").c_str(), speed);
    if (i > 0 && !(speed > stop.corners[i - 1].speed))
      check.fail("restitution",
                 point + shown(speed) + " is not above " + shown(stop.corners[i - 1].speed) + " of the point before");
    if (!(restitution >= 0.0 && restitution <= 1.0))
      check.fail("restitution", point + assigned("restitution", restitution) + " is outside [0, 1]");
  }
  if (!stop.corners.empty() && stop.corners.front().restitution != stop.restitution)
    check.fail("restitution", "the value is not that of the first corner");
  return check.result();
}

Found check_compliant_stop(const CompliantStop& stop, int index, const Model& model, std::set<std::string>& used) {
  Check check("compliant_stop", index);
  check_name(check, stop.name, used);
  check.ends(stop.a, stop.b, model);
  check.sized("clearance", stop.clearance);
  if (stop.stiffness == 0.0)
    check.fail("stiffness",
               "stiffness = 0 is not positive; a damper alone beyond a gap is a damper that acts within an interval");
  check.positive("stiffness", stop.stiffness);
  check.not_negative("damping", stop.damping);
  if (stop.bounded && stop.pulls) check.fail("law", "a stop whose damping force is bounded does not pull");
  return check.result();
}

Found check_characteristic(const Characteristic& one_of, int index, const Model& model, std::set<std::string>& used) {
  Check check("characteristic", index);
  check_name(check, one_of.name, used);
  check.ends(one_of.a, one_of.b, model);
  if (one_of.corners.empty())
    check.fail("characteristic", "there is no corner: a straight line is a stiffness or a coefficient");
  for (std::size_t i = 0; i < one_of.corners.size(); ++i) {
    const std::string point = "point " + std::to_string(i + 1);
    check.sized((point + ": position").c_str(), one_of.corners[i].at);
    check.sized((point + ": force").c_str(), one_of.corners[i].force);
    if (i > 0 && !(one_of.corners[i].at > one_of.corners[i - 1].at))
      check.fail("characteristic", point + ": " + shown(one_of.corners[i].at) + " is not above " +
                                       shown(one_of.corners[i - 1].at) + " of the point before");
  }
  check.sized("slope_below", one_of.slope_below);
  check.sized("slope_above", one_of.slope_above);
  return check.result();
}

/// omega and its highest multiple must be ordinary numbers, so that no later step overflows.
Found check_omega(const Model& model) {
  Check check("model", -1);
  check.not_negative("omega", model.omega);
  if (!model.forced()) return check.result();
  check.positive("omega", model.omega);
  for (const auto& force : model.forces)
    if (force.harmonic * model.omega > largest) check.fail("omega", assigned("omega", model.omega) + " is too large");
  return check.result();
}

/// How far forces and the start move a model with springs; 0 if it has none, or no force moves it: one state of a free
/// motion, which may be zero by chance, says nothing of its size.
double size_of_motion(const Model& model, const State& state) {
  double stiffness = 0.0, force = 0.0, size = 0.0;
  for (const auto& spring : model.springs) stiffness = std::max(stiffness, std::abs(spring.stiffness));
  for (const double entry : model.stiffness) stiffness = std::max(stiffness, std::abs(entry));
  for (const auto& one_of : model.characteristics)
    if (one_of.over == Characteristic::Over::displacement)
      stiffness = std::max({stiffness, std::abs(one_of.slope_below), std::abs(one_of.slope_above)});
  for (const auto& load : model.forces) force = std::max(force, std::abs(load.amplitude));
  for (const auto& friction : model.frictions)
    force = std::max(force, friction.static_friction * (friction.normal ? std::abs(friction.normal->constant) : 1.0));
  for (std::size_t i = 0; i < state.size(); i += 2) size = std::max(size, std::abs(state[i]));
  return stiffness > 0.0 && force > 0.0 ? std::max(size, force / stiffness) : 0.0;
}

/// The engine measures displacements from the stop: a stop that is too far away costs the motion all its digits.
template <class AnyStop>
Found far_stop(const char* kind, const std::vector<AnyStop>& stops, double size) {
  constexpr double farthest = 1e12;
  int index = 0;
  for (const auto& stop : stops) {
    if (size > 0.0 && std::abs(stop.clearance) > farthest * size)
      return Fault{kind, index, "clearance",
                   "stop " + in_quotes(stop.name) + ": " + assigned("clearance", stop.clearance) +
                       " is more than 1e12 times the motion's size, of the order of " + shown(size) +
                       ", which rounding would swallow; leave out a stop that is never reached"};
    ++index;
  }
  return std::nullopt;
}

/// Calls `check(part, index)` for each part until one of them finds a fault.
template <class Part, class CheckPart>
Found first_of(const std::vector<Part>& parts, CheckPart check) {
  int index = 0;
  for (const auto& part : parts)
    if (auto fault = check(part, index++)) return fault;
  return std::nullopt;
}

/// The name of a part, or "" where parts of that kind have none.
std::string part_name(const Fault& fault, const Model& model) {
  const auto i = static_cast<std::size_t>(fault.index);
  if (fault.part == "coordinate") return model.coordinates[i].name;
  if (fault.part == "friction") return model.frictions[i].name;
  if (fault.part == "stop") return model.stops[i].name;
  if (fault.part == "compliant_stop") return model.compliant_stops[i].name;
  if (fault.part == "characteristic") return model.characteristics[i].name;
  if (fault.part == "signal") return model.signals[i].name;
  return "";
}

}  // namespace

bool is_reserved(std::string_view name) { return std::find(reserved.begin(), reserved.end(), name) != reserved.end(); }

std::string Fault::place(const Model& model) const {
  if (index < 0) return part;
  const auto name = part_name(*this, model);
  return part + " " + (name.empty() ? std::to_string(index + 1) : in_quotes(name));
}

std::optional<Fault> first_fault(const Model& model) {
  if (model.coordinates.empty()) return Fault{"model", -1, "coordinate", "the model has no coordinates"};
  std::set<std::string> states, contacts;
  const auto massive = [&](int i) { return !model.mass.empty() || model.is_inner(i); };
  Found fault;
  const auto look = [&](const auto& parts, auto check) {
    if (!fault) fault = first_of(parts, check);
  };
  look(model.coordinates, [&](const auto& part, int i) { return check_coordinate(part, i, massive(i), states); });
  if (!fault) fault = first_matrix_fault(model);
  look(model.springs, [&](const auto& part, int i) { return check_spring(part, i, model, contacts); });
  look(model.dampers, [&](const auto& part, int i) { return check_damper(part, i, model, contacts); });
  look(model.signals, [&](const auto& part, int i) { return check_signal(part, i, model.forcing_period(), contacts); });
  look(model.forces, [&](const auto& part, int i) { return check_force(part, i, model); });
  look(model.frictions, [&](const auto& part, int i) { return check_friction(part, i, model, contacts); });
  look(model.stops, [&](const auto& part, int i) { return check_stop(part, i, model, contacts); });
  look(model.compliant_stops, [&](const auto& part, int i) { return check_compliant_stop(part, i, model, contacts); });
  look(model.characteristics, [&](const auto& part, int i) { return check_characteristic(part, i, model, contacts); });
  if (!fault) fault = first_inner_fault(model);
  if (!fault) fault = first_press_fault(model);
  if (!fault) fault = first_ratio_fault(model);
  if (!fault) fault = first_room_fault(model);
  return fault ? fault : check_omega(model);
}

std::optional<Fault> first_fault(const Model& model, const State& state) {
  const auto names = state_names(model);
  if (state.size() != names.size())
    return Fault{"state", -1, "",
                 std::to_string(state.size()) + " numbers given, " + std::to_string(names.size()) + " needed"};
  for (std::size_t i = 0; i < state.size(); ++i) {
    Check check("state", -1);
    check.sized(names[i].c_str(), state[i]);
    if (check.result()) return check.result();
  }
  const double size = size_of_motion(model, state);
  if (auto fault = far_stop("stop", model.stops, size)) return fault;
  if (auto fault = far_stop("compliant_stop", model.compliant_stops, size)) return fault;
  for (const auto& stop : model.stops) {
    const double gap = relative(stop, state, 0);
    // A state written out on a closed stop may come back rounded beyond it (Frame::enter takes it as contact).
    const bool exact = stop.clearance == 0.0 && !has_ratio(stop);
    const double rounding =
        exact ? 0.0
              : reading_error(model.size(), has_ratio(stop)) * (relative_size(stop, state) + std::abs(stop.clearance));
    if (gap <= stop.clearance + rounding) continue;
    const auto end = [&](int i, double by) {
      const std::string times = by == 1.0 ? "" : by < 0.0 ? "(" + shown(by) + ") " : shown(by) + " ";
      return i == ground ? std::string("ground") : times + names[static_cast<std::size_t>(2 * i)];
    };
    return Fault{"state", -1, names[static_cast<std::size_t>(2 * (stop.a == ground ? stop.b : stop.a))],
                 "stop " + in_quotes(stop.name) + " is violated: " + end(stop.a, stop.ratio.a) + " - " +
                     end(stop.b, stop.ratio.b) + " = " + shown(gap) + " > clearance = " + shown(stop.clearance),
                 true};
  }
  return std::nullopt;
}

}  // namespace slapstick
