/// Runs pixels in lanes, and asks at their points whether they have come to a cycle.
#include "sweep/lane_pixels.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

#include "attractor/cycle.hpp"
#include "base/floating_point.hpp"
#include "batch/runner.hpp"
#include "flow/translations.hpp"
#include "section/confirmation.hpp"
#include "section/settling.hpp"
#include "slapstick/base/error.hpp"
#include "sweep/diagram_point.hpp"

namespace slapstick::sweep {
namespace {

/// A pixel while its lane runs.
class LanePixel {
 public:
  LanePixel(const MapProblem& problem, const KnownCycles* known, const batch::PassedPoint& first)
      : problem_(problem),
        options_(options_of(problem)),
        wish_{problem.classify.most_n, returned, problem.classify.newton_start, waves},
        record_(2 * first.frame.n),
        omega_(2.0 * std::numbers::pi / first.model.forcing_period()),
        fits_(section::driven(first.model) && flow::translation_count(first.model, first.frame) == 0) {
    if (known != nullptr) known_.emplace(*known);
  }

  /// @returns true if nothing more is to be seen
  bool see(const batch::PassedPoint& point) {
    if (!fits_) return true;
    const int n = point.frame.n;
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * batch::most_coordinates, 1> x(2 * n);
    std::copy_n(point.p, n, x.data());
    std::copy_n(point.u, n, x.data() + n);
    // lanes tell no sticks: the cycle's own record does
    record_.add(x, {static_cast<int>(point.impacts), 0, 0}, omega_);
    if (known_) {
      if (const Classification* found = known_->see(x)) {
        finding_.found = *found;
        return decided_ = true;
      }
    }
    try {
      return decides(point);
    } catch (const NumericalError&) {  // a Motion says what is wrong
    } catch (const InputError&) {
    }
    fits_ = false;
    return true;
  }

  /// Nothing if a Motion has to decide.
  [[nodiscard]] std::optional<LaneFinding> take() {
    if (!fits_ || !decided_) return std::nullopt;
    return std::move(finding_);
  }

 private:
  // Of the motion's size. Each only says when to ask; Newton's method and the approach decide.
  /// A return that is worth Newton's method. Wider: asked sooner and oftener in vain; narrower: longer runs.
  static constexpr double returned = 1e-8;
  /// Where an approach has been seen. From 1e-3 on that is 13 halvings at the rate of the multiplier, where `classify`
  /// sees 23: wider, and a chaotic motion that comes nearer for a while may pass.
  static constexpr double there = 1e-7;
  /// A motion that winds more widely round the mean of its points is not tried. Narrower: more are undecided; wider:
  /// Newton's method runs in vain for chaotic ones.
  static constexpr double widest_round = 0.6;
  /// An oscillating approach is nearer than one of this number of returns before.
  static constexpr int waves = 3;

  /// Returns are looked for at every fourth point, and what only comes nearer at the end.
  bool decides(const batch::PassedPoint& point) {
    constexpr long every = 4;
    const long points = record_.size();
    const bool last = points >= problem_.periods;
    if (!last && (points % every != 0 || points < next_return_ || (known_ && known_->beside()))) return false;
    const auto candidates = record_.candidates(wish_, true, last);
    if (!candidates.empty() || last) {
      const section::Confirmation::Look look = confirm(point, candidates, last);
      if (stopped(problem_.cancel)) return true;
      if (look.cycle) return decided_ = true;
      if (look.refused_return != 0) next_return_ = points + 2 * every + points / 4;
    }
    if (last) give_up(point);
    return last;
  }

  section::Confirmation::Look confirm(const batch::PassedPoint& point,
                                      const std::vector<section::Candidate>& candidates, bool last) {
    if (finding_.system == nullptr) finding_.system = std::make_unique<System>(point.model);
    const System& system = *finding_.system;
    if (map_ == nullptr) map_ = std::make_unique<section::Stroboscopic>(system);
    State state = flow::user_state(system, record_.back(0));
    undo_rounding(point.model, state);
    const Motion motion(system, state);
    section::Confirmation::Look look = section::Confirmation(*map_, record_, motion, options_).first_of(candidates);
    if (last && !look.cycle) look.cycle = follow_on(motion, candidates);
    if (look.cycle && !stopped(problem_.cancel)) {
      ClassifyOptions options = problem_.classify;
      options.cancel = problem_.cancel;
      attractor::describe(system, *look.cycle, flow::user_state(system, look.cycle->x), options, finding_.found);
    }
    return look;
  }

  /// At the end of the periods a Motion goes on from there, as in `classify`, with the same candidates.
  [[nodiscard]] std::optional<section::Cycle> follow_on(const Motion& motion,
                                                        const std::vector<section::Candidate>& candidates) const {
    section::ConfirmationOptions options = options_;
    options.by_record = false;
    const section::Confirmation confirmation(*map_, record_, motion, options);
    section::Confirmation::Look look = confirmation.first_of(candidates);
    return look.cycle || stopped(problem_.cancel) ? look.cycle : confirmation.look_around();
  }

  void give_up(const batch::PassedPoint& point) {
    Classification& found = finding_.found;
    found.doubt = Doubt::not_confirmed;
    found.label = name(found.attractor);
    found.state.resize(2 * static_cast<std::size_t>(point.frame.n));
    point.frame.leave(point.p, point.u, found.state.data());
    undo_rounding(point.model, found.state);
    decided_ = true;
  }

  [[nodiscard]] static section::ConfirmationOptions options_of(const MapProblem& problem) {
    section::ConfirmationOptions options;
    options.most_n = problem.classify.most_n;
    options.widest_round = widest_round;
    options.by_record = true;
    options.there = there;
    options.tolerance = problem.classify.tolerance;
    options.stop = problem.cancel;
    return options;
  }

  const MapProblem& problem_;
  section::ConfirmationOptions options_;
  section::ReturnWish wish_;
  section::PointRecord record_;
  double omega_;
  bool fits_, decided_ = false;
  long next_return_ = 0;
  LaneFinding finding_;
  std::unique_ptr<section::Stroboscopic> map_;
  std::optional<KnownCycles::Watch> known_;
};

}  // namespace

void run_quick_in_lanes(const MapProblem& problem, std::span<const PixelTask> tasks, const KnownCycles* known,
                        const std::function<void(std::size_t, LaneFinding&&)>& take) {
  std::vector<std::unique_ptr<LanePixel>> pixels(tasks.size());
  std::size_t next = 0;
  batch::Queue queue;
  queue.next = [&] { return next < tasks.size() ? std::optional(next++) : std::nullopt; };
  queue.model_at = [&](std::size_t i) { return model_at(problem, tasks[i]); };
  queue.start_at = [&](std::size_t i, const Model& model) { return start_of(problem, tasks[i], model); };
  queue.plan = {.transient_periods = 0, .periods = problem.periods, .points = problem.periods};
  queue.wanted = batch::Queue::Wanted::those_of_lanes;
  queue.one_model = problem.one_model;
  queue.cancel = problem.cancel;
  queue.watch = [&](std::size_t i, const batch::PassedPoint& point) {
    if (pixels[i] == nullptr) pixels[i] = std::make_unique<LanePixel>(problem, known, point);
    return pixels[i]->see(point);
  };
  queue.take = [&](std::size_t i, BatchRun&& run) {
    const std::unique_ptr<LanePixel> pixel = std::move(pixels[i]);
    if (!run.done || pixel == nullptr) return;
    if (std::optional<LaneFinding> finding = pixel->take()) take(i, std::move(*finding));
  };
  batch::Runner(std::move(queue), batch::kernel()).run();
}

}  // namespace slapstick::sweep
