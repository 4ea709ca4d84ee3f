#include "slapstick/flow/system.hpp"

#include <algorithm>
#include <cmath>

#include "slapstick/base/error.hpp"
#include "slapstick/base/text.hpp"

namespace slapstick {

using mode::ContactStates;
using mode::FrictionState;
using mode::StopState;

namespace {

Model checked(Model model) {
  validate(model);
  const auto refuse = [&](std::size_t count, const char* what) {
    if (count > 1)
      throw InputError("model '" + model.name + "' has " + std::to_string(count) + " " + what +
                       "; models with at most one stop and one friction contact can be run");
  };
  refuse(model.stops.size(), "stops");
  refuse(model.frictions.size(), "friction contacts");
  return model;
}

/// Every combination of contact states; the stops vary fastest. System::mode_id is its inverse.
std::vector<ContactStates> all_states(std::size_t stops, std::size_t frictions) {
  std::vector<ContactStates> all{ContactStates{std::vector<StopState>(stops), std::vector<FrictionState>(frictions)}};
  for (std::size_t i = 0; i < stops; ++i) {
    const auto old = all;
    all.clear();
    for (StopState state : {StopState::open, StopState::closed}) {
      for (ContactStates states : old) {
        states.stops[i] = state;
        all.push_back(std::move(states));
      }
    }
  }
  for (std::size_t i = 0; i < frictions; ++i) {
    const auto old = all;
    all.clear();
    for (FrictionState state : {FrictionState::slip_minus, FrictionState::stick, FrictionState::slip_plus}) {
      for (ContactStates states : old) {
        states.frictions[i] = state;
        all.push_back(std::move(states));
      }
    }
  }
  return all;
}

/// The fastest rate of a mode: the largest modulus of an eigenvalue of its free motion, or its highest forcing frequency. Velocities are
/// measured in a unit that makes the entries of the matrix comparable, otherwise a stiff spring would cost the solver its digits.
double fastest_rate(const mode::Mode& mode, int n) {
  mode::Matrix A = mode.system().topLeftCorner(2 * n, 2 * n);
  const double unit = std::sqrt(A.bottomLeftCorner(n, n).cwiseAbs().maxCoeff());
  if (unit > 0.0) {
    A.topRightCorner(n, n) *= unit;
    A.bottomLeftCorner(n, n) /= unit;
  }
  const auto oscillators = mode.size() - 2 * n;
  const double forcing = mode.system().bottomRightCorner(oscillators, oscillators).cwiseAbs().maxCoeff();
  return std::max(A.eigenvalues().cwiseAbs().maxCoeff(), forcing);
}

/// A window is never much longer than the shortest time scale of its mode: the tail of its series would not be negligible. One that is
/// tells that numbers overflowed when it was computed.
/// @returns the window length @throws InputError
double checked_window(const Model& model, const mode::Mode& mode) {
  constexpr double longest = 16.0;  // times the fastest rate; without overflow it stays below 5
  const double rate = fastest_rate(mode, model.size()), window = mode.window();
  if (!(std::isfinite(rate) && window > 0.0 && window * rate <= longest))
    throw InputError("model '" + model.name +
                     "' has time scales too far apart for double precision (its fastest rate is " + shown(rate) +
                     "); bring masses, stiffnesses, damping and omega closer together");
  return window;
}

}  // namespace

System::System(Model model) : model_(checked(std::move(model))), frame_(model_), period_(model_.forcing_period()) {
  for (ContactStates& states : all_states(model_.stops.size(), model_.frictions.size()))
    modes_.emplace_back(model_, frame_, std::move(states));
  for (const mode::Mode& mode : modes_)
    if (mode.possible()) windows_per_period_ = std::max(windows_per_period_, period_ / checked_window(model_, mode));
  for (const mode::ContactRow& stop : frame_.stops) {
    const mode::Vector direction = frame_.mass_inverse * stop.row.transpose();
    impulses_.push_back(direction / stop.row.dot(direction));
    presses_.push_back(stop.row * frame_.free);
    for (std::size_t i = 0; i < frame_.frictions.size(); ++i) {
      const mode::RowVector& row = frame_.frictions[i].row;
      const bool same = row == stop.row || row == -stop.row;
      couplings_.push_back({row.dot(direction), same && model_.frictions[i].belt_speed == 0.0});
    }
  }
}

int System::mode_id(const ContactStates& states) const {
  int id = 0, stride = 1;
  for (StopState state : states.stops) {
    id += stride * static_cast<int>(state);
    stride *= 2;
  }
  for (FrictionState state : states.frictions) {
    id += stride * (static_cast<int>(state) + 1);
    stride *= 3;
  }
  return id;
}

std::string System::mode_name(int id) const {
  const ContactStates& states = modes_[id].states();
  std::string name;
  for (FrictionState state : states.frictions)
    name += std::string(name.empty() ? "" : ",") + (state == FrictionState::stick       ? "stick"
                                                    : state == FrictionState::slip_plus ? "slip+"
                                                                                        : "slip-");
  if (name.empty()) name = "free";
  for (StopState state : states.stops) name += state == StopState::closed ? "|closed" : "";
  return name;
}

std::string System::contact_name(int contact) const {
  const auto stops = static_cast<int>(model_.stops.size());
  return contact < stops ? model_.stops[contact].name : model_.frictions[contact - stops].name;
}

}  // namespace slapstick
