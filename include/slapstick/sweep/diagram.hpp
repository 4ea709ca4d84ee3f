#pragma once
/// Bifurcation diagrams: the impacts of the attractor at every value of a parameter, on all cores, with the same bits
/// on any number.
///
/// At each value the motion runs through a transient and then its next impacts are recorded.
///
///   reset  every value begins at the problem's own start: all values are independent tasks;
///   carry  a value begins where the transient of the value before ended, going up or down through the values, so that
///          the sweep stays on one attractor as long as it exists. A direction is one chain: only its transients are
///          sequential, the recording after each transient is a task of its own.
///
/// Up and down together show coexisting attractors: where they differ, there are two. A row depends on its own start
/// only and is stored by index; nothing depends on the order in which threads finish. Source: the seed paper's section
/// (eq. 8).
#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "slapstick/quantity/measure.hpp"
#include "slapstick/section/event_section.hpp"
#include "slapstick/section/stop_choice.hpp"

namespace slapstick::sweep {

enum class Direction { up, down, both };
enum class StartRule { carry, reset };

/// At which instants quantities are read (quantity/reader.hpp): just before impacts, at phase 0 of every forcing period
/// (without forcing at every unit of time), or just before events.
enum class ReadAt { impacts, periods, events };

struct InstantChoice {
  ReadAt read_at = ReadAt::impacts;
  EventChoice event = {};  ///< of ReadAt::events
};

/// Reads "impact", "period", or an event as "stick:belt"; "" is impact, of a model without stops period.
/// @throws InputError  no stop for "impact"; as parse_event_choice
[[nodiscard]] InstantChoice parse_instants(const std::string& text, const System& system);
/// @throws InputError  for a quantity that has no value at such instants, a parameter among them
void check_value_at(const Quantity& quantity, ReadAt instants);

struct DiagramPoint;

struct DiagramProblem {
  std::function<Model(double)> model_at;  ///< called from several threads at once
  std::function<State(double)> start_at;  ///< likewise; the start for `reset`, and of a chain
  double from = 0.0, to = 1.0;  ///< both are values of the diagram; the ones between are equidistant. from < to
  int count = 2;                ///< number of values, >= 2; or 1 if from == to
  /// Forcing periods (units of time for an unforced model) before recording, >= 0; nothing: 500, or of a model with a
  /// record what comes before that (quantity/span.hpp).
  std::optional<double> transient_periods = {};
  int impacts = 200;        ///< recorded per value and direction, >= 1
  int most_periods = 5000;  ///< a recording ends here if impacts are too rare, >= 1
  Direction direction = Direction::up;
  StartRule start = StartRule::carry;
  StopChoice stops = {};  ///< whose impacts are recorded (section/stop_choice.hpp); those of other stops end no flight
  /// Measured over `measured_periods` after the transient, in place of the impacts; then a model needs no stop.
  std::vector<Quantity> of = {};
  double measured_periods = 0.0;  ///< 0: 100, or what is left of a record
  /// Read at instants, in place of the impacts' own table: `impacts` rows at each value. A model needs no stop, except
  /// for `ReadAt::impacts`.
  std::vector<Quantity> values_of = {};
  ReadAt read_at = ReadAt::impacts;
  EventChoice event = {};  ///< of ReadAt::events
  int threads = 0;         ///< 0: all
  /// A point that need not be computed, because a run before has it, by its place in Diagram::points; or null. Called
  /// from several threads at once.
  std::function<const DiagramPoint*(std::size_t place)> known = {};
  /// Takes each point that is computed, from any of the threads, but never two at once.
  std::function<void(std::size_t place, const DiagramPoint&)> finished = {};
  /// Called after every value with the numbers done and to do; from any of the threads, but never two at once.
  std::function<void(int done, int total)> progress;
  const std::atomic<bool>* cancel = nullptr;  ///< set it and the sweep returns soon with what is complete
};

/// The impacts recorded at one value: a table of `size` rows, stored flat.
class ImpactTable {
 public:
  struct Row {
    double w;                       ///< relative velocity just before the impact, > 0
    double flight;                  ///< since the impact (or chatter limit) before, in forcing periods
    double sliding;                 ///< the part of it in which the friction contact slips
    double phase;                   ///< of the forcing, in [0, 1)
    int contact;                    ///< the stop that was hit: System::contact_name
    std::span<const double> state;  ///< just before the impact, user's coordinates
  };
  [[nodiscard]] std::size_t size() const { return width_ == 0 ? 0 : numbers_.size() / width_; }
  [[nodiscard]] Row operator[](std::size_t i) const {
    const double* row = numbers_.data() + i * width_;
    return {row[0], row[1], row[2], row[3], static_cast<int>(row[4]), {row + fixed, width_ - fixed}};
  }
  /// Appends a row. All states must have the same length.
  void add(const Row& row);
  /// All rows as they lie in memory, `row_width` numbers each; and a table of such.
  [[nodiscard]] const std::vector<double>& numbers() const { return numbers_; }
  [[nodiscard]] std::size_t row_width() const { return width_; }
  static ImpactTable of(std::vector<double> numbers, std::size_t row_width);
  friend bool operator==(const ImpactTable&, const ImpactTable&) = default;

 private:
  static constexpr std::size_t fixed = 5;  ///< numbers before the state
  std::size_t width_ = 0;
  std::vector<double> numbers_;
};

/// What was found at one value in one direction.
struct DiagramPoint {
  double parameter = 0.0;
  Direction direction = Direction::up;  ///< up or down
  bool done = false;                    ///< false only if the sweep was cancelled before
  ImpactTable impacts;                  ///< empty if there are none, or after a failure
  std::vector<Statistics> of;           ///< of each of DiagramProblem::of; empty after a failure
  std::vector<double> values;           ///< row by row, of each of DiagramProblem::values_of; empty after a failure
  double periods = 0.0;                 ///< length of the recording
  std::string failure;                  ///< one line, what the NumericalError or InputError said; else empty
  std::string note;                     ///< e.g. that the carried state does not fit this model; else empty
  State carried;                        ///< where the next value of a chain begins; empty: at its own start
  double carried_phase = 0.0;
  friend bool operator==(const DiagramPoint&, const DiagramPoint&) = default;
};

struct Diagram {
  /// Up: ascending values; down: after those of up, in descending order, as they were run.
  std::vector<DiagramPoint> points;
  bool complete = true;  ///< false if cancelled
  friend bool operator==(const Diagram&, const Diagram&) = default;
};

/// Value i of a sweep: from + i (to - from) / (count - 1), with the last one exactly `to`.
[[nodiscard]] double sweep_value(double from, double to, int count, int i);

/// Runs the sweep. A failure at one value is noted there and never ends the sweep; a chain goes on from the last state
/// it has.
/// @throws InputError for a meaningless problem (count, from, to, ...), naming the field; what `progress` throws
/// Cost: the periods of transient and recording, at about a microsecond each, over the threads. With `carry` the
/// transients of a direction take their own time in sequence whatever the number of threads.
[[nodiscard]] Diagram run_diagram(const DiagramProblem& problem);

}  // namespace slapstick::sweep
