/// Makes starts whose first event is nearly a graze.
#include "near_graze.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "flow/compiled_system.hpp"
#include "flow/mode_graph.hpp"
#include "mode/frame.hpp"

namespace campaign {
namespace {

using slapstick::State;
constexpr int most_size = 32, most_intervals = 256;

double velocity(const State& state, int coordinate) { return coordinate < 0 ? 0.0 : state[2 * coordinate + 1]; }

/// A guard along the grid: h for the start, and its change with the number (the knob) that is moved.
class Tuning {
 public:
  Tuning(Scene& scene, Random& random, Start& start, int knob, bool in_contact)
      : scene_(scene), random_(random), start_(start), knob_(knob), in_contact_(in_contact) {}

  bool run() {
    scene_.enter(start_.state, start_.phase, X_.data());
    flow_ = &scene_.flow(slapstick::flow::approaching_mode(scene_.system().compiled(), X_.data()));
    if (flow_->guards() == 0) return false;
    if (start_.guard < 0 || start_.guard >= flow_->guards()) start_.guard = random_.below(flow_->guards());
    if (in_contact_) start_.guard = 0;
    turn_knob(scene_.system().compiled().frame());
    const int j = minimum();
    return j > 0 && tune(j) && lawful();
  }

 private:
  void turn_knob(const slapstick::mode::Frame& frame) {
    const int first = knob_ % 2 == 0 ? 0 : frame.d;
    for (int i = 0; i < frame.d; ++i) turn_[first + i] = frame.W(i, knob_ / 2);
    for (int i = 0; i < flow_->size(); ++i) {
      const double* column = flow_->column(start_.guard, i);
      for (int j = 0; j <= scene_.intervals(); ++j) {
        h_[j] += column[j] * X_[i];
        r_[j] += column[j] * turn_[i];
      }
    }
  }

  /// A point of the grid near a local minimum that can be brought to zero while h stays positive before; 0 if there is
  /// no such point.
  [[nodiscard]] int minimum() const {
    int chosen = 0;
    for (int j = 2; j + 1 < scene_.intervals(); ++j) {
      if (!(h_[j] <= h_[j - 1] && h_[j] < h_[j + 1])) continue;
      const double move = -h_[j] / r_[j];
      bool before = std::abs(move) < 10.0;
      for (int i = 1; i < j && before; ++i) before = h_[i] + move * r_[i] > 0.0;
      if (before && (chosen == 0 || random_.one_in(2))) chosen = j;
    }
    return chosen;
  }

  /// Newton's method for h'(u) = 0 and h(u) = depth together, about the grid's point j.
  bool tune(int j) {
    std::array<long double, most_size> state{}, turned{};
    std::array<long double, ExactFlow::terms> a{}, b{};
    flow_->state<long double>(j, X_.data(), state.data());
    flow_->state<long double>(j, turn_.data(), turned.data());
    flow_->polynomial<long double>(start_.guard, state.data(), a.data());
    flow_->polynomial<long double>(start_.guard, turned.data(), b.data());
    const double size = std::ldexp(flow_->scale(start_.guard, X_.data()), -7 - random_.below(46));
    const long double depth = random_.sign() * size * random_.uniform(0.5, 1.0);
    long double u = 0, move = -h_[j] / r_[j];
    for (int i = 0; i < 5; ++i) {
      long double f = 0, f1 = 0, f2 = 0, r = 0;
      for (int n = ExactFlow::useful<long double> - 1; n >= 0; --n) {
        f2 = f2 * u + f1;
        f1 = f1 * u + f;
        f = f * u + a[n] + move * b[n];
        r = r * u + b[n];
      }
      if (!(f2 > 0) || r == 0) return false;
      move += (depth - (f - f1 * f1 / (4 * f2))) / r;
      u -= f1 / (2 * f2);
      if (!(std::abs(u) < 2)) return false;
    }
    start_.state[knob_] += static_cast<double>(move);
    return std::abs(start_.state[knob_]) < 1e3;
  }

  [[nodiscard]] bool lawful() const {
    if (!in_contact_) return scene_.lawful(start_.state);
    const slapstick::Stop& stop = scene_.system().model().stops[0];
    State opened = start_.state;
    opened[2 * stop.a] -= 1e-6;
    return scene_.lawful(opened) && velocity(opened, stop.a) < velocity(opened, stop.b);
  }

  Scene& scene_;
  Random& random_;
  Start& start_;
  const int knob_;
  const bool in_contact_;
  const ExactFlow* flow_ = nullptr;
  std::array<double, most_size> X_{}, turn_{};
  std::array<double, most_intervals> h_{}, r_{};
};

}  // namespace

Start random_start(const Scene& scene, Random& random) { return {scene.state(random), scene.phase(random)}; }

NearGrazes::Base NearGrazes::fresh() const {
  const auto& stops = scene_.system().model().stops;
  Base base{random_start(scene_, random_), 0, !stops.empty() && stops[0].a >= 0 && random_.one_in(4)};
  base.knob = base.in_contact ? 2 * stops[0].a + 1 : random_.below(static_cast<int>(base.start.state.size()));
  if (base.in_contact) touch(base);
  return base;
}

/// Puts the first stop's sides in contact, leaving.
void NearGrazes::touch(Base& base) const {
  const slapstick::Stop& stop = scene_.system().model().stops[0];
  State& state = base.start.state;
  state[2 * stop.a] = stop.clearance + (stop.b < 0 ? 0.0 : state[2 * stop.b]);
  state[base.knob] = velocity(state, stop.b) - std::abs(state[base.knob] - velocity(state, stop.b));
}

NearGrazes::Base NearGrazes::varied() const {
  Base base = good_[random_.below(static_cast<int>(good_.size()))];
  for (double& x : base.start.state) x += 0.1 * random_.uniform(-1.0, 1.0);
  base.start.phase += 0.1 * (scene_.phase(random_) - base.start.phase);
  if (base.in_contact) touch(base);
  return base;
}

bool NearGrazes::next(Start& out) {
  constexpr std::size_t enough = 64;
  const bool new_one = good_.empty() || (good_.size() < enough && random_.one_in(10)) || random_.one_in(50);
  Base base = new_one ? fresh() : varied();
  out = base.start;
  if (!Tuning(scene_, random_, out, base.knob, base.in_contact).run()) return false;
  if (!new_one) return true;
  base.start.guard = out.guard;
  if (good_.size() < enough)
    good_.push_back(base);
  else
    good_[random_.below(enough)] = base;
  return true;
}

}  // namespace campaign
