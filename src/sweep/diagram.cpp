/// Runs a diagram: which values are a chain, and what each does before and after it hands on.
#include "slapstick/sweep/diagram.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "sweep/diagram_point.hpp"
#include "sweep/executor.hpp"

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
  demand(problem.transient_periods.value_or(0.0) >= 0.0,
         "transient_periods = " + shown(problem.transient_periods.value_or(0.0)) + " is negative");
  at_least("impacts", problem.impacts, 1);
  at_least("most_periods", problem.most_periods, 1);
  demand(problem.measured_periods >= 0.0, "measured_periods = " + shown(problem.measured_periods) + " is negative");
  at_least("threads", problem.threads, 0);
  demand(problem.start == StartRule::carry || problem.direction != Direction::both,
         "with start = reset, up and down are the same: choose one of them, or start = carry");
}

/// One sweep while it runs.
class Run {
 public:
  explicit Run(const DiagramProblem& problem) : problem_(problem) {
    if (problem.direction != Direction::down)
      for (int i = 0; i < problem.count; ++i) add_point(i, Direction::up);
    if (problem.direction != Direction::up)
      for (int i = problem.count - 1; i >= 0; --i) add_point(i, Direction::down);
  }

  /// With `carry` a direction is a chain, with `reset` some values together are one cell.
  Diagram operator()() {
    diagram_.complete = carries() ? run_carried() : run_each();
    for (const DiagramPoint& point : diagram_.points) diagram_.complete = diagram_.complete && point.done;
    return std::move(diagram_);
  }

 private:
  void add_point(int i, Direction direction) {
    DiagramPoint& point = diagram_.points.emplace_back();
    point.parameter = sweep_value(problem_.from, problem_.to, problem_.count, i);
    point.direction = direction;
  }

  [[nodiscard]] bool carries() const { return problem_.start == StartRule::carry; }

  bool run_carried() {
    const int length = problem_.count, chains = static_cast<int>(diagram_.points.size()) / length;
    const auto body = [&](const Cell& cell, const Starts& start, const HandOn& hand_on) {
      run_point(static_cast<std::size_t>(cell.chain * length + cell.step), start.empty() ? Carried{} : start.front(),
                hand_on);
    };
    return run_chains({.chains = chains, .length = length}, problem_.threads, body, problem_.cancel);
  }

  /// Transients in the lanes of a batch, as many points to a cell as keep the lanes full and all threads busy.
  bool run_each() {
    constexpr std::size_t most_together = 64;
    const std::size_t all = diagram_.points.size(), together = std::clamp(all / 32, std::size_t{1}, most_together);
    const auto body = [&](const Cell& cell, const Starts&, const HandOn&) {
      const std::size_t begin = static_cast<std::size_t>(cell.chain) * together;
      run_together(begin, std::min(begin + together, all));
    };
    return run_chains({.chains = static_cast<int>((all + together - 1) / together)}, problem_.threads, body,
                      problem_.cancel);
  }

  void run_together(std::size_t begin, std::size_t end) {
    std::vector<Carried> begun(end - begin);
    bool unknown = false;  // lanes round otherwise than a Motion: what is left of a cell runs in lanes too
    for (std::size_t i = begin; i < end; ++i) unknown = unknown || !(problem_.known && problem_.known(i) != nullptr);
    if (unknown) run_in_lanes(problem_, {diagram_.points.data() + begin, end - begin}, begun);
    for (std::size_t i = begin; i < end; ++i) run_point(i, begun[i - begin], [](const Starts&) {});
  }

  /// The next value begins where this one's transient ends; after a failure where this one began.
  void run_point(std::size_t i, const Carried& begin, const HandOn& hand_on) {
    DiagramPoint& point = diagram_.points[i];
    if (const DiagramPoint* known = problem_.known ? problem_.known(i) : nullptr) {
      point = *known;
      hand_on({{point.carried, point.carried_phase}});
      return report(i, true);
    }
    std::optional<Settled> settled = settle(problem_, begin, point);
    const Carried next = settled ? carry_on(*settled) : begin;
    if (carries()) point.carried = next.state, point.carried_phase = next.fraction;
    if (settled) {
      hand_on({next});
      if (!cancelled(problem_)) record(problem_, std::move(*settled), point);
    }
    if (point.done) report(i, false);
  }

  void report(std::size_t i, bool known) {
    const std::scoped_lock lock(progress_);
    if (problem_.finished && !known) problem_.finished(i, diagram_.points[i]);
    if (problem_.progress) problem_.progress(++done_, static_cast<int>(diagram_.points.size()));
  }

  const DiagramProblem& problem_;
  Diagram diagram_;
  std::mutex progress_;
  int done_ = 0;
};

}  // namespace

InstantChoice parse_instants(const std::string& text, const System& system) {
  const bool stops = !stop_contacts(system.model()).empty();
  if (text == "period" || (text.empty() && !stops)) return {ReadAt::periods};
  if (!text.empty() && text != "impact") return {ReadAt::events, parse_event_choice(text, system)};
  if (!stops) throw InputError("impact: model '" + system.model().name + "' has no stop; 'period' needs none");
  return {ReadAt::impacts};
}

void check_value_at(const Quantity& quantity, ReadAt instants) {
  if (quantity.kind == Quantity::Kind::parameter)
    throw InputError("'" + quantity.name + "' is a parameter, which no motion changes");
  const bool speed = quantity.kind == Quantity::Kind::speed && instants == ReadAt::impacts;
  if (quantity.at_impacts() && !speed)
    throw InputError("'" + quantity.name + "' is a quantity at impacts: give it a statistic, as " + quantity.name +
                     ":mean");
}

Diagram run_diagram(const DiagramProblem& problem) {
  check(problem);
  return Run(problem)();
}

}  // namespace slapstick::sweep
