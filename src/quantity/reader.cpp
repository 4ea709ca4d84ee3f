/// Evaluates the formulas of quantities at instants of a motion.
#include "slapstick/quantity/reader.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "base/floating_point.hpp"
#include "flow/engine.hpp"
#include "quantity/formula.hpp"
#include "slapstick/section/stop_choice.hpp"

namespace slapstick {

using quantity::Formula;
using quantity::Formulas;

struct Reader::Parts {
  Parts(const System& of_system, std::vector<Quantity> quantities)
      : system(of_system), of(std::move(quantities)), values(of.size()), X(system.compiled().frame().size()) {}

  /// The formulas of a mode, for each of the ways in which its kinks' rows may be signed.
  struct Mode {
    Mode(const Model& model, const mode::Frame& frame, std::shared_ptr<const mode::Outline> the_outline)
        : outline(std::move(the_outline)), formulas(model, frame, *outline) {}
    std::shared_ptr<const mode::Outline> outline;
    Formulas formulas;
    std::map<std::vector<bool>, std::vector<Formula>> known;
  };

  Mode& mode(ModeId id) {
    auto& found = modes[id];
    if (!found)
      found = std::make_unique<Mode>(system.model(), system.compiled().frame(), system.compiled().outline(id));
    return *found;
  }

  const std::vector<Formula>& formulas(Mode& in) {
    above.clear();
    for (const quantity::Row& row : in.formulas.kinks()) above.push_back(row.value.dot(X) > 0.0);
    auto& known = in.known[above];
    if (known.empty())
      for (const Quantity& one : of) known.push_back(in.formulas.of(one, above));
    return known;
  }

  /// The values at X in a mode. @param event  at which X is, or null
  const std::vector<double>& read(ModeId id, const Event* event) {
    const IeeeArithmetic ieee;
    const std::vector<Formula>& all = formulas(mode(id));
    for (std::size_t k = 0; k < of.size(); ++k) {
      values[k] = of[k].at_impacts() ? speed(of[k], event) : all[k].linear.value.dot(X);
      for (const auto& [left, right] : all[k].products) values[k] += left.value.dot(X) * right.value.dot(X);
    }
    return values;
  }

  static double speed(const Quantity& quantity, const Event* event) {
    const bool has = quantity.kind == Quantity::Kind::speed && event != nullptr && StopChoice().is_point(*event) &&
                     (quantity.index < 0 || quantity.index == event->contact);
    return has ? event->w : std::numeric_limits<double>::quiet_NaN();
  }

  void take(std::span<const double> numbers) {
    std::copy_n(numbers.data(), std::min<std::ptrdiff_t>(std::ssize(numbers), X.size()), X.data());
  }

  System system;
  std::vector<Quantity> of;
  std::vector<double> values;
  mode::Vector X;
  std::vector<bool> above;
  std::map<ModeId, std::unique_ptr<Mode>> modes;
};

Reader::Reader(const System& system, std::vector<Quantity> of)
    : parts_(std::make_unique<Parts>(system, std::move(of))) {}
Reader::~Reader() = default;
Reader::Reader(Reader&&) noexcept = default;
Reader& Reader::operator=(Reader&&) noexcept = default;

const std::vector<Quantity>& Reader::of() const { return parts_->of; }

const std::vector<double>& Reader::within(const Motion& motion, double s) {
  const Motion::Segment segment = motion.segment();
  parts_->take(motion.engine().extended_within(s));
  return parts_->read(segment.duration > 0.0 ? segment.mode : motion.mode_id(), nullptr);
}

const std::vector<double>& Reader::before(const Motion& motion) {
  parts_->take(motion.engine().extended_of_event());
  return parts_->read(motion.segment().mode, &motion.event());
}

const std::vector<double>& Reader::now(const Motion& motion) {
  parts_->take(motion.engine().extended());
  return parts_->read(motion.mode_id(), nullptr);
}

}  // namespace slapstick
