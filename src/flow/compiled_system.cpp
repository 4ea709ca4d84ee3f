/// Compiles a model: its frame, its modes when they are asked for, and what impacts do.
#include "flow/compiled_system.hpp"

#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "base/floating_point.hpp"
#include "base/ranges.hpp"
#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::flow {

using mode::CompliantState;
using mode::ContactStates;
using mode::FrictionState;
using mode::StopState;

namespace {

Model checked(Model model) {
  validate(model);
  const std::size_t contacts =
      model.stops.size() + model.frictions.size() + model.compliant_stops.size() + model.characteristics.size();
  if (contacts > System::most_contacts)
    throw InputError("model '" + model.name + "' has " + std::to_string(contacts) + " contacts; at most " +
                     std::to_string(System::most_contacts) + " can be run");
  return model;
}

/// The free motion of a mode, velocities in a unit that makes the entries of the matrix comparable: otherwise a stiff
/// spring would cost the eigenvalue solver its digits.
mode::Matrix balanced(const mode::Mode& mode, int d) {
  mode::Matrix A = mode.system().topLeftCorner(2 * d, 2 * d);
  const double unit = std::sqrt(A.bottomLeftCorner(d, d).cwiseAbs().maxCoeff());
  if (unit > 0.0) {
    A.topRightCorner(d, d) *= unit;
    A.bottomLeftCorner(d, d) /= unit;
  }
  return A;
}

/// The highest forcing frequency.
double forcing_rate(const mode::Mode& mode, const mode::Frame& frame) {
  const auto oscillators = frame.signal(0) - 2 * frame.d;
  return oscillators == 0
             ? 0.0
             : mode.system().block(2 * frame.d, 2 * frame.d, oscillators, oscillators).cwiseAbs().maxCoeff();
}

/// A window is never much longer than the shortest time scale of its mode: the tail of its series would not be
/// negligible. One that is tells that numbers overflowed when it was computed. The fastest rate is the largest modulus
/// of an eigenvalue, which the largest row sum bounds.
/// @returns the window length @throws InputError
double checked_window(const Model& model, const mode::Mode& mode, const mode::Frame& frame) {
  constexpr double longest = 16.0;  // times the fastest rate; without overflow it stays below 5
  const mode::Matrix A = balanced(mode, frame.d);
  const double forcing = forcing_rate(mode, frame), window = mode.window();
  const auto fits = [&](double rate) { return std::isfinite(rate) && window > 0.0 && window * rate <= longest; };
  if (fits(std::max(A.cwiseAbs().rowwise().sum().maxCoeff(), forcing))) return window;
  const double rate = std::max(std::sqrt(dense::eigenvalues(A).cwiseAbs2().maxCoeff()), forcing);
  if (!fits(rate))
    throw InputError("model '" + model.name +
                     "' has time scales too far apart for double precision (its fastest rate is " + shown(rate) +
                     "); bring masses, stiffnesses, damping and omega closer together");
  return window;
}

/// The clock's fraction of a period has 53 bits; a window must be many of its units.
constexpr double most_windows_per_period = 0x1p48;

constexpr ModeId most_modes = ModeId{1} << 62;

ModeId pieces(const Characteristic& characteristic) { return static_cast<ModeId>(characteristic.corners.size()) + 1; }

/// What a unit force of each contact makes of all u', without its sign.
std::vector<mode::Vector> reaches(const mode::Frame& frame) {
  std::vector<mode::Vector> all;
  for (const auto* rows : {&frame.stops, &frame.frictions, &frame.compliant})
    for (const mode::ContactRow& row : *rows) all.push_back(frame.mass_inverse.col(row.own));
  for (const mode::PairRows& row : frame.characteristics) all.push_back(row.push);
  return all;
}

/// The group of each contact, called by the last of them. Two contacts that share no mass have no u' that both change.
std::vector<int> groups(const std::vector<mode::Vector>& reaches) {
  std::vector<int> all;
  for (std::size_t a = 0; a < reaches.size(); ++a) {
    const auto name = static_cast<int>(a);
    all.push_back(name);
    for (std::size_t b = 0; b < a; ++b) {
      const int other = all[b];
      if ((reaches[a].array() * reaches[b].array() != 0.0).any()) std::replace(all.begin(), all.end(), other, name);
    }
  }
  return all;
}

/// In periods: a flight counts its windows as a number of the clock, whose steps this is far above.
constexpr double shortest_cap = 0x1p-20;

}  // namespace

CompiledSystem::CompiledSystem(Model model, SystemOptions options)
    : model_(checked(std::move(model))), frame_(model_), options_(options), period_(model_.forcing_period()) {
  if (!(options_.longest_window >= shortest_cap))
    throw InputError("longest_window = " + shown(options_.longest_window) + " is not at least " + shown(shortest_cap));
  for (std::size_t i = 0; i < model_.stops.size(); ++i) mode_count_ *= 2;
  for (std::size_t i = 0; i < model_.frictions.size(); ++i) mode_count_ *= friction_states(i);
  for (std::size_t i = 0; i < model_.compliant_stops.size(); ++i) mode_count_ *= compliant_states(i);
  for (const Characteristic& one_of : model_.characteristics) {
    if (mode_count_ > most_modes / pieces(one_of))
      throw InputError("model '" + model_.name + "' has more combinations of contact states and pieces than 2^62");
    mode_count_ *= pieces(one_of);
  }
  modes_ = std::make_unique<ModeTable>(mode_count_);
  ContactStates free = states(0);
  windows_per_period_ = period_ / mode(mode_id(free)).window();
  ranges::fill(free.compliant, CompliantState::on);
  windows_per_period_ = std::max(windows_per_period_, period_ / mode(mode_id(free)).window());
  for (std::size_t i = 0; i < model_.characteristics.size(); ++i)
    for (; free.pieces[i] + 1 < pieces(model_.characteristics[i]); ++free.pieces[i])
      windows_per_period_ = std::max(windows_per_period_, period_ / mode(mode_id(free)).window());
  if (windows_per_period_ > most_windows_per_period)
    throw InputError("model '" + model_.name + "' has " + shown(windows_per_period_) +
                     " windows of its fastest motion in a forcing period, more than the clock can tell apart; raise "
                     "omega or slow the "
                     "model down");
  for (const mode::ContactRow& stop : frame_.stops) {
    impulses_.emplace_back(stop.sign * frame_.mass_inverse.col(stop.own) / frame_.mass_inverse(stop.own, stop.own));
    presses_.emplace_back(stop.sign * frame_.free.row(stop.own));
    for (const mode::ContactRow& friction : frame_.frictions) {
      couplings_.push_back({stop.sign * friction.sign * frame_.mass_inverse(stop.own, friction.own),
                            frame_.in_step(stop.own, friction.own)});
    }
  }
  groups_ = groups(reaches(frame_));
}

mode::Mode CompiledSystem::build(ModeId id) const {
  const IeeeArithmetic ieee;
  mode::Mode built(model_, frame_, states(id), options_.longest_window);
  (void)checked_window(model_, built, frame_);
  return built;
}

std::shared_ptr<const mode::Outline> CompiledSystem::outline(ModeId id) const {
  return modes_->outline(id, [this](ModeId wanted) { return mode::Outline(model_, frame_, states(wanted)); });
}

ModeId CompiledSystem::mode_id(const ContactStates& states) const {
  ModeId id = 0, stride = 1;
  const auto digit = [&](int value, int base) {
    id += stride * value;
    stride *= base;
  };
  for (StopState state : states.stops) digit(static_cast<int>(state), 2);
  for (std::size_t i = 0; i < model_.frictions.size(); ++i)
    digit(static_cast<int>(states.frictions[i]) + 1, friction_states(i));
  for (std::size_t i = 0; i < model_.compliant_stops.size(); ++i)
    digit(static_cast<int>(states.compliant[i]), compliant_states(i));
  for (std::size_t i = 0; i < model_.characteristics.size(); ++i)
    digit(states.pieces[i], static_cast<int>(pieces(model_.characteristics[i])));
  return id;
}

ContactStates CompiledSystem::states(ModeId id) const {
  ContactStates states;
  const auto digit = [&](int base) {
    const auto value = static_cast<int>(id % base);
    id /= base;
    return value;
  };
  for (std::size_t i = 0; i < model_.stops.size(); ++i) states.stops.push_back(static_cast<StopState>(digit(2)));
  for (std::size_t i = 0; i < model_.frictions.size(); ++i)
    states.frictions.push_back(static_cast<FrictionState>(digit(friction_states(i)) - 1));
  for (std::size_t i = 0; i < model_.compliant_stops.size(); ++i)
    states.compliant.push_back(static_cast<CompliantState>(digit(compliant_states(i))));
  for (const Characteristic& one_of : model_.characteristics)
    states.pieces.push_back(digit(static_cast<int>(pieces(one_of))));
  return states;
}

std::string CompiledSystem::mode_name(ModeId id) const {
  const ContactStates all = states(id);
  std::string name;
  for (FrictionState state : all.frictions)
    name += std::string(name.empty() ? "" : "/") + (state == FrictionState::stick       ? "stick"
                                                    : state == FrictionState::slip_plus ? "slip+"
                                                    : state == FrictionState::unloaded  ? "unloaded"
                                                                                        : "slip-");
  if (name.empty()) name = "free";
  const bool several = model_.stops.size() + model_.compliant_stops.size() > 1;
  const auto named = [&](const std::string& what) { return several ? ":" + what : std::string(); };
  for (std::size_t i = 0; i < all.stops.size(); ++i)
    if (all.stops[i] == StopState::closed) name += "|closed" + named(model_.stops[i].name);
  for (std::size_t i = 0; i < all.compliant.size(); ++i) {
    if (all.compliant[i] == CompliantState::on) name += "|on" + named(model_.compliant_stops[i].name);
    if (all.compliant[i] == CompliantState::bounded) name += "|bounded" + named(model_.compliant_stops[i].name);
  }
  for (std::size_t i = 0; i < all.pieces.size(); ++i)
    name += "|" + model_.characteristics[i].name + ":" + std::to_string(all.pieces[i]);
  return name;
}

std::string CompiledSystem::contact_name(int contact) const {
  const auto stops = static_cast<int>(model_.stops.size()), frictions = static_cast<int>(model_.frictions.size());
  if (contact < stops) return model_.stops[contact].name;
  contact -= stops;
  if (contact < frictions) return model_.frictions[contact].name;
  contact -= frictions;
  const auto compliant = static_cast<int>(model_.compliant_stops.size());
  if (contact < compliant) return model_.compliant_stops[contact].name;
  contact -= compliant;
  const auto characteristics = static_cast<int>(model_.characteristics.size());
  return contact < characteristics ? model_.characteristics[contact].name
                                   : model_.signals[contact - characteristics].name;
}

}  // namespace slapstick::flow
