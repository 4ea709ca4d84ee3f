#pragma once
/// Quantities at instants of a motion: what tables, sections and observables read.
///
///     Reader reader(system, {find_quantity(all, "F_stop"), find_quantity(all, "a1")});
///     while (motion.advance(end) == Outcome::event) use(reader.before(motion));
///
/// A value is that of the formulas of docs/reference/measure.md at the state, with no step of its own: forces and
/// accelerations are those of the mode on one side of the instant. A quantity at impacts has a value at an impact or
/// engagement only, and there w alone; impulses and flights belong to `measure`. Where it has none the value is NaN.
/// Cost: some hundred nanoseconds an instant, and some microseconds for each mode that is met. Threads: one at a time.
/// Source: docs/reference/measure.md.
#include <memory>
#include <vector>

#include "slapstick/flow/motion.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick {

class Reader {
 public:
  /// @param system  of the motions that are read
  Reader(const System& system, std::vector<Quantity> of);
  ~Reader();
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;

  [[nodiscard]] const std::vector<Quantity>& of() const;

  /// At time s of the motion's last segment, as Motion::sample. All results are valid until the next call.
  [[nodiscard]] const std::vector<double>& within(const Motion& motion, double s);
  /// Just before the motion's last event, in the mode that it ended: as Motion::before.
  [[nodiscard]] const std::vector<double>& before(const Motion& motion);
  /// Where the motion stands, in its present mode: as Motion::state.
  [[nodiscard]] const std::vector<double>& now(const Motion& motion);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slapstick
