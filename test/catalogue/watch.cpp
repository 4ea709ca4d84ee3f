#include "catalogue/watch.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "flow/compiled_system.hpp"
#include "flow/engine.hpp"
#include "flow/mode_graph.hpp"
#include "mode/exact_flow.hpp"
#include "mode/mode.hpp"

namespace slapstick::catalogue {
namespace {

/// q_a - q_b of displacements (part 0) or velocities (part 1).
double difference(std::span<const double> state, int a, int b, int part) {
  const auto at = [&](int i) { return i == ground ? 0.0 : state[2 * static_cast<std::size_t>(i) + part]; };
  return at(a) - at(b);
}

double kinetic(const Model& model, std::span<const double> state) {
  double energy = 0.0;
  for (int i = 0; i < model.size(); ++i)
    energy += 0.5 * model.coordinates[i].mass * std::pow(difference(state, i, ground, 1), 2);
  return energy;
}

void raise(double& largest, double value) { largest = std::max(largest, value); }

class Momentum : public Watch {
 public:
  explicit Momentum(const System& system) : system_(system), model_(system.model()) {}

  void event(const Motion& motion, Values& values) override {
    double& momentum = values["momentum_defect"];
    double& loss = values["loss_defect"];
    double& law = values["law_defect"];
    const Event& event = motion.event();
    if (event.kind != EventKind::impact) return;
    const Stop& stop = model_.stops[event.contact];
    const double* X = motion.engine().extended().data();
    raise(law, std::abs(flow::gap(system_.compiled(), event.contact, X)));
    raise(law, std::abs(flow::approach_velocity(system_.compiled(), event.contact, X) + stop.restitution * event.w));
    const auto before = motion.before();
    const State after = motion.state();
    double change = 0.0, size = 0.0, size_after = 0.0, inverse = 0.0;
    for (int i = 0; i < model_.size(); ++i) {
      const double m = model_.coordinates[i].mass, v = before[2 * i + 1];
      change += m * (after[2 * i + 1] - v);
      size += std::abs(m * v);
      size_after += std::abs(m * after[2 * i + 1]);
      if (i == stop.a || i == stop.b) inverse += 1.0 / m;
    }
    if (stop.a != ground && stop.b != ground) raise(momentum, std::abs(change) / std::max(size, size_after) / 0x1p-52);
    const double energy = kinetic(model_, before), lost = energy - kinetic(model_, after);
    const double expected = (1 - stop.restitution * stop.restitution) * event.w * event.w / (2 * inverse);
    raise(loss, std::abs(lost - expected) / energy);
  }

 private:
  const System& system_;
  const Model& model_;
};

/// Gauss-Legendre nodes and weights of order eight on [-1, 1].
constexpr double node[4] = {0.18343464249564981, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623};
constexpr double weight[4] = {0.36268378337836198, 0.31370664587788729, 0.22238103445337448, 0.10122853629037626};

class Work : public Watch {
 public:
  explicit Work(const System& system) : system_(system), model_(system.model()), state_(2 * model_.size()) {}

  void event(const Motion& motion, Values& values) override {
    double& defect = values["work_defect"];
    const Motion::Segment segment = motion.segment();
    if (segment.duration == 0.0) return;
    const auto power_at = [&](double s) {
      motion.sample(s, state_);
      return power(segment, s);
    };
    const int pieces = 1 + static_cast<int>(segment.duration * 4 * (1 + model_.omega));
    const double half = 0.5 * segment.duration / pieces;
    double work = 0.0;
    for (int i = 0; i < pieces; ++i) {
      for (int k = 0; k < 4; ++k)
        work += half * weight[k] * (power_at((2 * i + 1 + node[k]) * half) + power_at((2 * i + 1 - node[k]) * half));
    }
    motion.sample(0.0, state_);
    const double begun = energy();
    motion.sample(segment.duration, state_);
    raise(defect, std::abs(energy() - begun - work));
  }

 private:
  [[nodiscard]] double energy() const {
    double sum = kinetic(model_, state_);
    for (const Spring& s : model_.springs) sum += 0.5 * s.stiffness * std::pow(difference(state_, s.a, s.b, 0), 2);
    return sum;
  }

  [[nodiscard]] double power(const Motion::Segment& segment, double s) const {
    double sum = 0.0;
    const double phase = 2 * std::numbers::pi * segment.start.fraction + model_.omega * s;
    for (const Force& f : model_.forces) {
      const double force = f.harmonic == 0 ? f.amplitude : f.amplitude * std::sin(f.harmonic * phase + f.phase);
      sum += force * difference(state_, f.coordinate, ground, 1);
    }
    for (const Damper& d : model_.dampers) sum -= d.coefficient * std::pow(difference(state_, d.a, d.b, 1), 2);
    const auto& sliding = system_.compiled().mode(segment.mode).states().frictions;
    for (std::size_t i = 0; i < sliding.size(); ++i) {
      const FrictionContact& f = model_.frictions[i];
      sum -= static_cast<int>(sliding[i]) * f.kinetic_friction * difference(state_, f.a, f.b, 1);
    }
    return sum;
  }

  const System& system_;
  const Model& model_;
  State state_;
};

class Reverse : public Watch {
 public:
  explicit Reverse(const System& system) : system_(system) {}

  void event(const Motion& motion, Values& values) override {
    using mode::testing::Real;
    double& defect = values["reverse_defect"];
    const Motion::Segment segment = motion.segment();
    const mode::Mode& mode = system_.compiled().mode(segment.mode);
    if (segment.duration == 0.0 || motion.event().kind == EventKind::chatter) return;
    const auto m = static_cast<std::size_t>(mode.size());
    const auto begun = motion.engine().extended_at_start(), end = motion.engine().extended_before();
    mode::testing::Exact X(m);
    for (std::size_t i = 0; i < m; ++i) X[i] = end[i];
    mode::Matrix back = mode::Matrix::Identity(mode.size(), mode.size());
    const int steps = 1 + static_cast<int>(segment.duration / mode.window());
    const Real step = Real(segment.duration) / steps;
    for (int k = 0; k < steps; ++k) X = mode::testing::flow(mode.system(), X, -step);
    for (int i = 0; i < mode.size(); ++i) back.col(i) = column(mode, i, steps, -step);
    for (std::size_t i = 0; i < m; ++i) {
      double size = 0.0;
      for (std::size_t j = 0; j < m; ++j) size += std::abs(back(i, j)) * std::max(std::abs(end[j]), 1.0);
      raise(defect, abs(X[i] - Real(begun[i])).convert_to<double>() / (size * steps) / 0x1p-53);
    }
  }

 private:
  /// exp(A s) e_i.
  static mode::Vector column(const mode::Mode& mode, int i, int steps, const mode::testing::Real& step) {
    mode::testing::Exact e(static_cast<std::size_t>(mode.size()), 0);
    e[static_cast<std::size_t>(i)] = 1;
    for (int k = 0; k < steps; ++k) e = mode::testing::flow(mode.system(), e, step);
    mode::Vector out(mode.size());
    for (int j = 0; j < mode.size(); ++j) out[j] = e[static_cast<std::size_t>(j)].convert_to<double>();
    return out;
  }

  const System& system_;
};

}  // namespace

std::unique_ptr<Watch> make_watch(const std::string& kind, const System& system) {
  if (kind == "momentum") return std::make_unique<Momentum>(system);
  if (kind == "work") return std::make_unique<Work>(system);
  if (kind == "reverse") return std::make_unique<Reverse>(system);
  throw std::invalid_argument("no watch '" + kind + "'");
}

}  // namespace slapstick::catalogue
