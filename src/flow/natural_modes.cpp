/// Computes eigenvalues and shapes of a machine in one combination of contact states.
#include "slapstick/flow/natural_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

#include "base/dense.hpp"
#include "base/text.hpp"
#include "flow/engine.hpp"
#include "flow/linear_motion.hpp"
#include "flow/mode_graph.hpp"
#include "mode/contact_force.hpp"
#include "mode/outline.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick {
namespace {

/// Columns Z: the directions of the first n displacements in which no held contact moves, G Z = 0.
Eigen::MatrixXd free_directions(const mode::Frame& frame, const mode::ContactStates& states) {
  std::vector<int> held;
  for (std::size_t i = 0; i < states.stops.size(); ++i)
    if (states.stops[i] == mode::StopState::closed) held.push_back(frame.stops[i].own);
  for (std::size_t i = 0; i < states.frictions.size(); ++i)
    if (states.frictions[i] == mode::FrictionState::stick) held.push_back(frame.frictions[i].own);
  for (const mode::SliderRow& row : frame.sliders) held.push_back(row.own);  // at rest, or with no force of its own
  if (held.empty()) return Eigen::MatrixXd::Identity(frame.n, frame.n);
  Eigen::MatrixXd G(static_cast<Eigen::Index>(held.size()), frame.n);
  for (std::size_t i = 0; i < held.size(); ++i) G.row(static_cast<Eigen::Index>(i)) = frame.dependence.row(held[i]);
  constexpr double dependent = 0x1p-40;  // rows of a loop of contacts, up to the rounding of W
  return dense::kernel(G, dependent).basis;
}

using Motions = std::vector<flow::LinearMotion>;

bool is_near(const flow::LinearMotion& motion, double rate) {
  constexpr double apart = 0.05;  // of the rate: nearer eigenvalues of A would spoil each other's digits
  return std::norm(motion.lambda + rate) <= apart * apart * rate * rate;
}

/// Takes out what is no motion: rates of inner coordinates that settle (mode::InnerRow).
/// @param faster  by what their settling is multiplied
/// @returns false if a mode is near one of them
bool drop_settling(const mode::Frame& frame, double faster, Motions& motions) {
  for (const mode::InnerRow& row : frame.inner)
    motions.erase(std::min_element(motions.begin(), motions.end(), [&](const auto& a, const auto& b) {
      return std::norm(a.lambda + faster * row.settling) < std::norm(b.lambda + faster * row.settling);
    }));
  return std::none_of(motions.begin(), motions.end(), [&](const flow::LinearMotion& motion) {
    return std::any_of(frame.inner.begin(), frame.inner.end(),
                       [&](const mode::InnerRow& row) { return is_near(motion, faster * row.settling); });
  });
}

/// The motions of a mode in the directions Z. How fast a rate settles is no matter of the machine: it settles at rates
/// that are not near those of modes.
Motions motions_of(const mode::Frame& frame, const mode::Matrix& system, const Eigen::MatrixXd& Z) {
  constexpr double next = 1.25;
  const Eigen::MatrixXd back = dense::LeastNorm(Z).pseudo_inverse();
  const Eigen::Index n = frame.n, d = frame.d;
  const Eigen::Index most = 2 * n * static_cast<Eigen::Index>(frame.inner.size()) + 1;  // one is near no mode
  double faster = 1.0;
  for (Eigen::Index k = 1;; ++k, faster *= next) {
    mode::Matrix A = system;
    for (const mode::InnerRow& row : frame.inner) {
      A.row(frame.u(row.own)) += (faster - 1.0) * row.settling * row.rate;
      A(frame.u(row.own), frame.u(row.own)) -= (faster - 1.0) * row.settling;
    }
    const auto over = [&](Eigen::Index from) {
      return Eigen::MatrixXd(back * (A.block(d, from, d, d) * frame.dependence).topRows(n) * Z);
    };
    Motions motions = flow::linear_motions(over(0), over(d));
    if (drop_settling(frame, faster, motions) || k >= most) return motions;
  }
}

/// Displacements of the coordinates, scaled: the largest becomes 1.
std::vector<std::complex<double>> scaled(const Eigen::VectorXcd& shape) {
  Eigen::Index largest = 0;
  shape.cwiseAbs2().maxCoeff(&largest);
  std::vector<std::complex<double>> result(static_cast<std::size_t>(shape.size()));
  for (Eigen::Index i = 0; i < shape.size(); ++i)
    result[static_cast<std::size_t>(i)] = i == largest ? 1.0 : shape[i] / shape[largest];
  return result;
}

/// The place of a name in a list of contacts of a model.
template <class Contacts>
std::optional<std::size_t> place_of(const std::string& name, const Contacts& contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts[i].name == name) return i;
  return std::nullopt;
}

template <class Contacts>
std::string names_of(const Contacts& contacts) {
  std::string names;
  for (const auto& contact : contacts) names += (names.empty() ? "" : ", ") + contact.name;
  return names;
}

/// The sense in which a contact slips at a state; w > 0 where w is zero.
mode::FrictionState sense(const Motion& motion, std::size_t contact) {
  const double* X = motion.engine().extended().data();
  const double w = flow::sliding_velocity(motion.system().compiled(), static_cast<int>(contact), X);
  return w < 0.0 ? mode::FrictionState::slip_minus : mode::FrictionState::slip_plus;
}

/// Has a contact a normal force in these states? One that a closed compliant stop presses has, and others by what the
/// load is at the state of the motion.
bool presses(const Motion& motion, const mode::ContactStates& states, std::size_t contact) {
  const Model& model = motion.system().model();
  const std::optional<NormalForce>& normal = model.frictions[contact].normal;
  if (!normal) return true;
  const int pad = normal->compliant_stop;
  if (pad >= 0 && states.compliant[static_cast<std::size_t>(pad)] == mode::CompliantState::on) return true;
  const mode::RowVector load =
      mode::load_row(model, motion.system().compiled().frame(), states, static_cast<int>(contact));
  const auto X = motion.engine().extended();
  return load.dot(Eigen::Map<const Eigen::VectorXd>(X.data(), load.size())) > 0.0;
}

[[noreturn]] void refuse(const Model& model, const std::string& name, const char* kind, const std::string& known) {
  throw InputError("model " + in_quotes(model.name) + " has no " + kind + " " + in_quotes(name) +
                   (known.empty() ? ", nor any other" : "; the model has " + known));
}

}  // namespace

double NaturalMode::cycles() const {
  return std::sqrt(std::max(0.0, (frequency - decay) * (frequency + decay))) / (2.0 * std::numbers::pi);
}

mode::ContactStates sliding_states(const System& system, const State& state, const std::vector<std::string>& stuck,
                                   const std::vector<std::string>& closed) {
  const Model& model = system.model();
  const Motion motion(system, state);
  mode::ContactStates states = system.states(motion.mode_id());
  std::fill(states.stops.begin(), states.stops.end(), mode::StopState::open);
  std::fill(states.compliant.begin(), states.compliant.end(), mode::CompliantState::off);
  for (const std::string& name : closed) {
    if (const auto stop = place_of(name, model.stops)) {
      states.stops[*stop] = mode::StopState::closed;
    } else if (const auto pad = place_of(name, model.compliant_stops)) {
      states.compliant[*pad] = mode::CompliantState::on;
    } else {
      const std::string rigid = names_of(model.stops), compliant = names_of(model.compliant_stops);
      refuse(model, name, "stop", rigid + (rigid.empty() || compliant.empty() ? "" : ", ") + compliant);
    }
  }
  for (std::size_t i = 0; i < states.frictions.size(); ++i) {
    const bool slips =
        states.frictions[i] == mode::FrictionState::slip_plus || states.frictions[i] == mode::FrictionState::slip_minus;
    if (!presses(motion, states, i))
      states.frictions[i] = mode::FrictionState::unloaded;
    else if (!slips)
      states.frictions[i] = sense(motion, i);
  }
  for (const std::string& name : stuck) {
    const auto friction = place_of(name, model.frictions);
    if (!friction) refuse(model, name, "friction contact", names_of(model.frictions));
    states.frictions[*friction] = mode::FrictionState::stick;
  }
  return states;
}

/// With displacements Z a and velocities Z a' the mode is a'' = Z^+ (A_21 Z a + A_22 Z a').
std::vector<NaturalMode> natural_modes(const System& system, const mode::ContactStates& states) {
  const mode::Frame& frame = system.compiled().frame();
  const Eigen::MatrixXd Z = free_directions(frame, states);
  if (Z.cols() == 0) return {};
  std::vector<NaturalMode> modes;
  for (const flow::LinearMotion& motion : motions_of(frame, mode::Outline(system.model(), frame, states).system, Z)) {
    if (motion.lambda.imag() < 0.0) continue;
    NaturalMode mode{.shape = scaled(frame.W_inverse * (Z * motion.shape))};
    if (motion.lambda.imag() > 0.0) mode.frequency = std::sqrt(std::norm(motion.lambda));
    if (!(std::abs(motion.lambda.real()) <= motion.error)) mode.decay = -motion.lambda.real();
    modes.push_back(std::move(mode));
  }
  std::sort(modes.begin(), modes.end(), [](const NaturalMode& a, const NaturalMode& b) {
    return std::tie(a.frequency, a.decay) < std::tie(b.frequency, b.decay);
  });
  return modes;
}

}  // namespace slapstick
