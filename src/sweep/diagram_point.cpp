/// Runs one value of a diagram: transient, then recording.
#include "sweep/diagram_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/floating_point.hpp"
#include "batch/runner.hpp"
#include "section/run_impacts.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/quantity/reader.hpp"
#include "slapstick/quantity/span.hpp"

namespace slapstick::sweep {
namespace {

/// Runs `body`; what it throws becomes the point's failure. Running out of memory is no property of the point.
template <class Body>
bool attempt(DiagramPoint& point, const Body& body) {
  try {
    body();
    return true;
  } catch (const NumericalError& error) {
    point.failure = error.what();
  } catch (const InputError& error) {
    point.failure = error.what();
  }
  point.impacts = {};
  point.values = {};
  point.done = true;
  return false;
}

Motion start_motion(const DiagramProblem& problem, const Carried& carried, const System& system, DiagramPoint& point) {
  if (!carried.state.empty()) {
    State state = carried.state;
    undo_rounding(system.model(), state);
    try {
      return Motion(system, state, Instant{carried.periods, carried.fraction});
    } catch (const InputError& error) {
      if (carried.periods == 0) point.note = std::string("started anew: ") + error.what();
    }
  }
  return Motion(system, problem.start_at(point.parameter));
}

Instant after(const ImpactSection& section, int periods) {
  const Instant now = section.motion().time();
  return {now.period + periods, now.fraction};
}

/// Whole periods leave the phase as it is, to the last bit.
Instant later(Instant from, double periods) {
  const double whole = std::floor(periods);
  return Instant{from.period + static_cast<std::int64_t>(whole), from.fraction}.plus(periods - whole);
}

constexpr double usual_transient = 500.0, usual_length = 100.0;

/// A record begins at its own time; else the transient's periods pass first, from the phase at which the value began.
Instant end_of_transient(const DiagramProblem& problem, const Motion& motion) {
  const auto record = record_of(motion.system().model());
  if (record && !problem.transient_periods) return Instant{}.plus(record->begin);
  return later({0, motion.time().fraction}, problem.transient_periods.value_or(usual_transient));
}

double measured_length(const DiagramProblem& problem, const Motion& motion) {
  return stretch_of(motion.system().model(), motion.time().since({}), problem.measured_periods, usual_length).periods;
}

}  // namespace

double sweep_value(double from, double to, int count, int i) {
  if (count == 1 || i == 0) return from;
  return i == count - 1 ? to : from + (to - from) * (static_cast<double>(i) / (count - 1));
}

void undo_rounding(const Model& model, State& state) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Stop& stop : model.stops) {
    const auto excess = [&] { return relative(stop, state, 0) - stop.clearance; };
    const double scale = std::max(relative_size(stop, state), std::abs(stop.clearance));
    if (excess() > 4.0 * std::numeric_limits<double>::epsilon() * scale) continue;  // a violation, not a rounding error
    const bool of_a = stop.a != ground;
    double& x = state[2 * static_cast<std::size_t>(of_a ? stop.a : stop.b)];
    const double outwards = (of_a ? stop.ratio.a < 0.0 : stop.ratio.b > 0.0) ? infinity : -infinity;
    for (int i = 0; i < 16 && excess() > 0.0; ++i) x = std::nextafter(x, outwards);
  }
}

void run_in_lanes(const DiagramProblem& problem, std::span<const DiagramPoint> points, std::span<Carried> begun) {
  constexpr int last_periods = 20;
  const int periods = static_cast<int>(problem.transient_periods.value_or(usual_transient)) - last_periods;
  if (periods < 1) return;
  std::size_t next = 0;
  const auto parameter = [&](std::size_t i) { return points[i].parameter; };
  batch::Queue queue;
  queue.next = [&] { return next < points.size() ? std::optional(next++) : std::nullopt; };
  queue.model_at = [&](std::size_t i) { return problem.model_at(parameter(i)); };
  queue.start_at = [&](std::size_t i, const Model&) { return problem.start_at(parameter(i)); };
  queue.wanted = batch::Queue::Wanted::those_of_lanes;
  queue.plan.periods = periods;
  queue.cancel = problem.cancel;
  queue.take = [&](std::size_t i, BatchRun&& run) {
    if (run.done) begun[i] = {std::move(run.end), 0.0, periods};
  };
  batch::Runner(std::move(queue), batch::kernel()).run();
}

std::optional<Settled> settle(const DiagramProblem& problem, const Carried& carried, DiagramPoint& point) {
  const IeeeArithmetic ieee;
  std::optional<Settled> settled;
  bool interrupted = false;
  const bool good = attempt(point, [&] {
    auto system = std::make_shared<const System>(problem.model_at(point.parameter));
    const bool impacts = problem.of.empty() && (problem.values_of.empty() || problem.read_at == ReadAt::impacts);
    if (impacts && stop_contacts(system->model()).empty())
      throw InputError("model '" + system->model().name + "' has no stop, so there are no impacts to record");
    ImpactSection section(start_motion(problem, carried, *system, point), problem.stops);
    const Instant end = end_of_transient(problem, section.motion());
    interrupted = !run_impacts(section, end, problem.cancel, [](const SectionPoint&) { return true; });
    if (interrupted) return;
    settled.emplace(Settled{std::move(system), std::move(section)});
  });
  if (!good || interrupted) return std::nullopt;
  return settled;
}

Carried carry_on(const Settled& settled) {
  const Motion& motion = settled.section.motion();
  return {motion.state(), motion.time().fraction};
}

namespace {

/// Rows of quantities at instants, until there are enough or the time is over. @returns false if it was stopped
bool read_values(const DiagramProblem& problem, const Settled& settled, std::vector<double>& rows) {
  Motion motion = settled.section.motion();
  Reader reader(*settled.system, problem.values_of);
  const auto wanted = static_cast<std::size_t>(problem.impacts) * problem.values_of.size();
  const Instant begin = motion.time(), end{begin.period + problem.most_periods, begin.fraction};
  const auto add = [&](const std::vector<double>& row) {
    rows.insert(rows.end(), row.begin(), row.end());
    return rows.size() < wanted;
  };
  if (problem.read_at == ReadAt::impacts) {
    ImpactSection section(std::move(motion), problem.stops);
    return run_impacts(section, end, problem.cancel,
                       [&](const SectionPoint&) { return add(reader.before(section.motion())); });
  }
  if (problem.read_at == ReadAt::periods) {
    do {
      if (!run_to(motion, {motion.time().period + 1, 0.0}, problem.cancel, [] {})) return false;
    } while (add(reader.now(motion)) && motion.time() < end);
    return true;
  }
  EventSection section(std::move(motion), problem.event);
  EventPoint event;
  while (section.next(end, event, problem.cancel))
    if (!add(reader.before(section.motion()))) return true;
  return !cancelled(problem);
}

}  // namespace

void record(const DiagramProblem& problem, Settled settled, DiagramPoint& point) {
  const IeeeArithmetic ieee;
  bool interrupted = false;
  const bool good = attempt(point, [&] {
    ImpactSection& section = settled.section;
    const Instant begin = section.motion().time();
    if (!problem.of.empty()) {
      const Instant end = later(begin, measured_length(problem, section.motion()));
      Measured found = measure(section.motion(), end, problem.of, problem.cancel);
      interrupted = !found.complete;
      if (!interrupted) point.of = std::move(found.of);
      return;
    }
    if (!problem.values_of.empty()) {
      interrupted = !read_values(problem, settled, point.values);
      return;
    }
    const Instant end = after(section, problem.most_periods);
    interrupted = !run_impacts(section, end, problem.cancel, [&](const SectionPoint& impact) {
      if (!std::isnan(impact.flight))
        point.impacts.add({impact.w, impact.flight, impact.sliding, impact.phase, impact.contact, impact.state});
      return point.impacts.size() < static_cast<std::size_t>(problem.impacts);
    });
    if (interrupted) return;
    point.periods = section.motion().time().since(begin);
  });
  if (interrupted) point.impacts = {}, point.values = {};
  point.done = !good || !interrupted;
}

ImpactTable ImpactTable::of(std::vector<double> numbers, std::size_t row_width) {
  if (row_width == 0 ? !numbers.empty() : row_width <= fixed || numbers.size() % row_width != 0)
    throw InputError("ImpactTable: the numbers are no rows of " + std::to_string(row_width));
  ImpactTable table;
  table.numbers_ = std::move(numbers);
  table.width_ = row_width;
  return table;
}

void ImpactTable::add(const Row& row) {
  if (width_ == 0) width_ = fixed + row.state.size();
  if (width_ != fixed + row.state.size()) throw std::logic_error("ImpactTable: states of different length");
  numbers_.insert(numbers_.end(), {row.w, row.flight, row.sliding, row.phase, static_cast<double>(row.contact)});
  numbers_.insert(numbers_.end(), row.state.begin(), row.state.end());
}

}  // namespace slapstick::sweep
