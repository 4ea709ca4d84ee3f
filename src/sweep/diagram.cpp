/// Runs a diagram: chains of transients, and recordings on the thread pool.
#include "slapstick/sweep/diagram.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <cmath>
#include <mutex>
#include <optional>

#include "slapstick/base/error.hpp"
#include "base/text.hpp"
#include "sweep/diagram_point.hpp"
#include "sweep/fork_join.hpp"

namespace slapstick::sweep {
namespace {

void demand(bool good, const std::string& message) {
  if (!good) throw InputError("diagram: " + message);
}

void check(const DiagramProblem& problem) {
  const auto at_least = [](const char* name, int value, int least) {
    demand(value >= least, std::string(name) + " = " + std::to_string(value) + " is below " + std::to_string(least));
  };
  demand(problem.model_at != nullptr && problem.start_at != nullptr, "model_at and start_at must be given");
  demand(std::isfinite(problem.from) && std::isfinite(problem.to), "from and to must be finite");
  if (problem.count == 1) {
    demand(problem.from == problem.to, "one value needs from == to");
  } else {
    at_least("count", problem.count, 2);
    demand(problem.from < problem.to, "from = " + shown(problem.from) + " is not below to = " + shown(problem.to));
  }
  at_least("transient_periods", problem.transient_periods, 0);
  at_least("impacts", problem.impacts, 1);
  at_least("most_periods", problem.most_periods, 1);
  at_least("measured_periods", problem.measured_periods, 1);
  at_least("threads", problem.threads, 0);
  demand(problem.start == StartRule::carry || problem.direction != Direction::both,
         "with start = reset, up and down are the same: choose one of them, or start = carry");
}

/// One sweep while it runs: the results, and the tasks that fill them.
class Run {
 public:
  explicit Run(const DiagramProblem& problem) : problem_(problem) {
    if (problem.direction != Direction::down)
      for (int i = 0; i < problem.count; ++i) add_point(i, Direction::up);
    if (problem.direction != Direction::up)
      for (int i = problem.count - 1; i >= 0; --i) add_point(i, Direction::down);
  }

  Diagram operator()() {
    settled_.resize(diagram_.points.size());
    if (problem_.start == StartRule::carry) {
      run_chains();
    } else {
      run_each();
    }
    for (const DiagramPoint& point : diagram_.points) diagram_.complete = diagram_.complete && point.done;
    return std::move(diagram_);
  }

 private:
  void add_point(int i, Direction direction) {
    DiagramPoint& point = diagram_.points.emplace_back();
    point.parameter = sweep_value(problem_.from, problem_.to, problem_.count, i);
    point.direction = direction;
  }

  void run_each() {
    for (std::size_t i = 0; i < diagram_.points.size(); ++i)
      spawn([this, i] {
        if (settle_point(i, {})) record_point(i);
      });
    tasks_.wait();
    fork_join::join();
  }

  void run_chains() {
    const auto chain = static_cast<std::size_t>(problem_.count);
    for (std::size_t begin = 0; begin < diagram_.points.size(); begin += chain)
      spawn([this, begin, chain] { run_chain(begin, begin + chain); });
    tasks_.wait();
    fork_join::join();
  }

  /// A task whose captures are plain numbers and pointers.
  template <class Body>
  void spawn(const Body& body) {
    auto task = tasks_.defer([body] {
      fork_join::enter();
      body();
      fork_join::leave();
    });
    fork_join::fork();  // what the task needs is written by now
    tasks_.run(std::move(task));
  }

  /// Transients one after the other, recordings for whoever is free. When too many wait, because the others are busy or
  /// there are none, the chain records itself: a waiting recording holds a System.
  void run_chain(std::size_t begin, std::size_t end) {
    Carried carried;
    for (std::size_t i = begin; i < end && !cancelled(problem_); ++i) {
      if (!settle_point(i, carried)) continue;
      carried = carry_on(*settled_[i]);
      if (waiting_ < most_waiting) {
        ++waiting_;
        spawn([this, i] {
          --waiting_;
          record_point(i);
        });
      } else {
        record_point(i);
      }
    }
  }

  bool settle_point(std::size_t i, const Carried& carried) {
    if (cancelled(problem_)) return false;
    DiagramPoint& point = diagram_.points[i];
    settled_[i] = settle(problem_, carried, point);
    if (!settled_[i] && point.done) report();
    return settled_[i].has_value();
  }

  void record_point(std::size_t i) {
    if (!cancelled(problem_)) record(problem_, std::move(*settled_[i]), diagram_.points[i]);
    settled_[i].reset();
    if (diagram_.points[i].done) report();
  }

  void report() {
    if (!problem_.progress) return;
    const std::lock_guard lock(progress_);
    problem_.progress(++done_, static_cast<int>(diagram_.points.size()));
  }

  const DiagramProblem& problem_;
  Diagram diagram_;
  std::vector<std::optional<Settled>> settled_;  // between a point's transient and its recording
  static constexpr int most_waiting = 32;
  std::atomic<int> waiting_{0};  // recordings that no thread has begun
  tbb::task_group tasks_;
  std::mutex progress_;
  int done_ = 0;
};

}  // namespace

Diagram run_diagram(const DiagramProblem& problem) {
  check(problem);
  std::optional<tbb::global_control> more_than_there_are_cores;
  if (problem.threads > 0)
    more_than_there_are_cores.emplace(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(problem.threads));
  tbb::task_arena arena(problem.threads > 0 ? problem.threads : tbb::task_arena::automatic);
  return arena.execute([&] { return Run(problem)(); });
}

}  // namespace slapstick::sweep
