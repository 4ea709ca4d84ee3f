/// Makes what a batch of random segments shares: a compiled model and the exact flow of its modes.
#include "scene.hpp"

#include <algorithm>
#include <cmath>

#include "flow/compiled_system.hpp"
#include "mode/frame.hpp"

namespace campaign {

using slapstick::ModeId;
using slapstick::State;
using slapstick::System;

namespace {

double at(const State& state, int coordinate) { return coordinate == slapstick::ground ? 0.0 : state[2 * coordinate]; }

}  // namespace

Scene::Scene(Random& random, Phase phase) : system_(std::make_unique<System>(random_model(random))), phase_(phase) {
  intervals_ = 48 + random.below(81);
  spacing_ = system_->period() / system_->windows_per_period() / 16.0;
  const double reach = random.decades(-0.5, 0.5);
  for (int i = 0; i < system_->model().size(); ++i) {
    reach_.push_back(reach);
    reach_.push_back(reach * random.decades(-0.3, 0.3));
  }
  middle_.assign(reach_.size(), 0.0);
  for (const slapstick::Stop& stop : system_->model().stops) {
    const double gap = stop.clearance - at(middle_, stop.a) + at(middle_, stop.b);
    if (gap < 0.2 * reach && stop.a != slapstick::ground) middle_[2 * stop.a] += gap - 0.2 * reach;
  }
}

const ExactFlow& Scene::flow(ModeId mode) {
  auto& flow = flows_[mode];
  if (!flow) flow = std::make_unique<ExactFlow>(system_->compiled().mode(mode), spacing_, intervals_ + 1);
  return *flow;
}

void Scene::enter(const State& state, double phase, double* X) const {
  system_->compiled().frame().enter(state.data(), X);
  system_->compiled().frame().set_clock(slapstick::Instant{0, phase}, X);
}

bool Scene::lawful(const State& state) const {
  return std::ranges::all_of(system_->model().stops, [&](const slapstick::Stop& stop) {
    return at(state, stop.a) - at(state, stop.b) < stop.clearance;
  });
}

double Scene::phase(Random& random) const { return phase_ == Phase::zero ? 0.0 : random.uniform(0.0, 1.0); }

State Scene::state(Random& random) const {
  State state(reach_.size());
  do {
    for (std::size_t i = 0; i < state.size(); ++i) state[i] = middle_[i] + reach_[i] * random.uniform(-1.0, 1.0);
  } while (!lawful(state));
  return state;
}

}  // namespace campaign
