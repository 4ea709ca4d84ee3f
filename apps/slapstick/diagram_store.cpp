/// Puts the points of a diagram into a store, and takes them out.
#include "diagram_store.hpp"

#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

/// Numbers one after another: lists with their length before them.
class Writer {
 public:
  explicit Writer(std::vector<double>& to) : to_(to) {}
  void number(double value) { to_.push_back(value); }
  void list(const std::vector<double>& values) {
    to_.push_back(static_cast<double>(values.size()));
    to_.insert(to_.end(), values.begin(), values.end());
  }

 private:
  std::vector<double>& to_;
};

class Reader {
 public:
  explicit Reader(const StoredCell& cell) : cell_(cell) {}
  double number() {
    if (at_ == cell_.numbers.size()) fail();
    return cell_.numbers[at_++];
  }
  std::size_t count() {
    const double value = number();
    if (!(value >= 0.0 && value <= static_cast<double>(cell_.numbers.size()))) fail();
    return static_cast<std::size_t>(value);
  }
  std::vector<double> list() {
    const std::size_t size = count();
    if (size > cell_.numbers.size() - at_) fail();
    const auto first = cell_.numbers.begin() + static_cast<std::ptrdiff_t>(at_);
    at_ += size;
    return {first, first + static_cast<std::ptrdiff_t>(size)};
  }
  void end() const {
    if (at_ != cell_.numbers.size()) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw StorageError("the store's cell " + std::to_string(cell_.number) + " does not belong to this diagram");
  }
  const StoredCell& cell_;
  std::size_t at_ = 0;
};

void write(const Statistics& of, Writer& to) {
  for (const double value : {of.mean, of.rms, of.least, of.greatest, of.least_at, of.greatest_at, of.impulse,
                             static_cast<double>(of.impulses)})
    to.number(value);
  to.list(of.values);
}

Statistics statistics(Reader& from) {
  Statistics of;
  for (double* value : {&of.mean, &of.rms, &of.least, &of.greatest, &of.least_at, &of.greatest_at, &of.impulse})
    *value = from.number();
  of.impulses = static_cast<long>(from.number());
  of.values = from.list();
  return of;
}

}  // namespace

/// The note is kept beside the failure: of the two a point has one at most.
StoredCell cell_of(std::size_t place, const sweep::DiagramPoint& point) {
  StoredCell cell{static_cast<std::int64_t>(place), {}, point.failure, point.carried};
  cell.carried.push_back(point.carried_phase);
  Writer to(cell.numbers);
  to.number(point.periods);
  to.number(static_cast<double>(point.impacts.row_width()));
  to.list(point.impacts.numbers());
  to.list(point.values);
  to.number(static_cast<double>(point.of.size()));
  for (const Statistics& of : point.of) write(of, to);
  std::vector<double> note(point.note.begin(), point.note.end());
  to.list(note);
  return cell;
}

sweep::DiagramPoint point_of(const StoredCell& cell) {
  sweep::DiagramPoint point;
  Reader from(cell);
  point.done = true;
  point.failure = cell.failure;
  point.periods = from.number();
  const std::size_t width = from.count();
  point.impacts = sweep::ImpactTable::of(from.list(), width);
  point.values = from.list();
  const std::size_t statistics_there = from.count();
  for (std::size_t k = 0; k < statistics_there; ++k) point.of.push_back(statistics(from));
  for (const double letter : from.list()) point.note += static_cast<char>(letter);
  from.end();
  point.carried = cell.carried;
  if (!point.carried.empty()) {
    point.carried_phase = point.carried.back();
    point.carried.pop_back();
  }
  return point;
}

DiagramStore::DiagramStore(Store store, sweep::DiagramProblem& problem) : store_(std::move(store)) {
  const int directions = problem.direction == sweep::Direction::both ? 2 : 1;
  known_.resize(static_cast<std::size_t>(problem.count) * directions);
  const auto value = [&](std::size_t place) {
    const auto count = static_cast<std::size_t>(problem.count);
    const bool down = problem.direction == sweep::Direction::down || place >= count;
    const int i = static_cast<int>(place % count);
    return std::pair(down ? problem.count - 1 - i : i, down);
  };
  store_.for_each([&](const StoredCell& cell) {
    if (cell.number < 0 || cell.number >= static_cast<std::int64_t>(known_.size()))
      throw StorageError("the store's cell " + std::to_string(cell.number) + " does not belong to this diagram");
    const auto place = static_cast<std::size_t>(cell.number);
    const auto [i, down] = value(place);
    known_[place] = point_of(cell);
    known_[place].parameter = sweep::sweep_value(problem.from, problem.to, problem.count, i);
    known_[place].direction = down ? sweep::Direction::down : sweep::Direction::up;
  });
  problem.known = [this](std::size_t place) { return known_[place].done ? &known_[place] : nullptr; };
  problem.finished = [this](std::size_t place, const sweep::DiagramPoint& point) {
    store_.add(std::vector<StoredCell>{cell_of(place, point)});
  };
}

}  // namespace slapstick::app
