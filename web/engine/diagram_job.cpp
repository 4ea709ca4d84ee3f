/// Runs the values of a diagram one after the other, each from where the transient of the one before ended.
#include "diagram_job.hpp"

#include <array>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::web {
namespace {

using sweep::ReadAt;

constexpr std::array<const char*, 4> of_impacts{"w", "flight", "sliding", "phase"};

/// Is it a column of the impacts' own table?
bool is_of_impacts(const std::string& shown) {
  return std::find(of_impacts.begin(), of_impacts.end(), shown) != of_impacts.end();
}

double column(const sweep::ImpactTable::Row& row, const std::string& shown) {
  const std::array<double, 4> values{row.w, row.flight, row.sliding, row.phase};
  return values[static_cast<std::size_t>(std::find(of_impacts.begin(), of_impacts.end(), shown) - of_impacts.begin())];
}

}  // namespace

DiagramJob::DiagramJob(const Choice& choice, const DiagramWish& wish) : wish_(wish) {
  const auto at = [choice, name = wish.parameter](double value) { return Overrides{{name, value}}; };
  problem_.model_at = [choice, at](double value) { return choice.model(at(value)); };
  problem_.start_at = [choice, at](double value) { return choice.start_at(at(value)); };
  problem_.from = wish.from, problem_.to = wish.to, problem_.count = wish.count;
  problem_.transient_periods = wish.transient, problem_.impacts = wish.points;
  problem_.most_periods = 10 * wish.points;
  width_ = 3;
  const Model model = choice.model();
  event_width_ = static_cast<int>(1 + 2 * model.coordinates.size());
  if (wish.at == "impacts" && is_of_impacts(wish.shown)) return;
  problem_.values_of = quantities_of(choice, wish.shown);
  problem_.read_at = wish.at == "impacts" ? ReadAt::impacts : wish.at == "periods" ? ReadAt::periods : ReadAt::events;
  if (problem_.read_at == ReadAt::events) problem_.event = parse_event_choice(wish.at, System(model));
}

bool DiagramJob::work(const Deadline& deadline) {
  while (next_ < wish_.count) {
    run_value(wish_.down ? wish_.count - 1 - next_ : next_);
    ++next_;
    if (deadline.passed()) break;
  }
  return next_ == wish_.count;
}

void DiagramJob::run_value(int index) {
  sweep::DiagramPoint point;
  point.parameter = sweep::sweep_value(wish_.from, wish_.to, wish_.count, index);
  point.direction = wish_.down ? sweep::Direction::down : sweep::Direction::up;
  if (auto settled = sweep::settle(problem_, carried_, point)) {
    carried_ = sweep::carry_on(*settled);
    events_.push_back(static_cast<double>(index));
    events_.insert(events_.end(), carried_.state.begin(), carried_.state.end());
    sweep::record(problem_, std::move(*settled), point);
  }
  if (!point.failure.empty() && note_.empty())
    note_ = wish_.parameter + " = " + shown(point.parameter) + ": " + point.failure;
  add(index, point);
}

void DiagramJob::add(int index, const sweep::DiagramPoint& point) {
  const auto add_row = [&](double value) {
    rows_.insert(rows_.end(), {static_cast<double>(index), point.parameter, value});
  };
  for (std::size_t i = 0; i < point.impacts.size(); ++i) add_row(column(point.impacts[i], wish_.shown));
  for (const double value : point.values) add_row(value);
}

}  // namespace slapstick::web
