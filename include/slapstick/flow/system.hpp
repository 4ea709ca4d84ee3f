#pragma once
/// A model made ready to run. Const and shareable: any number of motions on any threads use one System.
///
/// A *mode* is a combination of contact states (mode/contact_states.hpp); in it the model is a linear system, for which
/// a System keeps the operators of one *window*, a short time in which every guard is a polynomial. Modes are compiled
/// when they are first met, and kept: of the 2^s 3^f combinations of s stops and f friction contacts a motion meets a
/// handful. A new System has one: it costs about ten microseconds, and so does every mode, for two coordinates.
///
/// Contacts have one numbering: stops first, then friction contacts, then compliant stops, then
/// characteristics.
///
/// Threads: all functions are const and safe to call at once, also while modes are compiled.
/// Source: docs/developers/architecture.md, sections 2 and 3; docs/developers/proofs.md for error bounds.
#include <limits>
#include <memory>
#include <string>

#include "slapstick/mode/contact_states.hpp"
#include "slapstick/model/model.hpp"

namespace slapstick {

namespace flow {
class CompiledSystem;
}

struct SystemOptions {
  /// Windows are no longer than this, in forcing periods (at least 2^-20). Events do not depend on it beyond rounding;
  /// the work does.
  double longest_window = std::numeric_limits<double>::infinity();
};

/// A handle of a compiled model: a copy is cheap and stands for the same compiled model, which lives as long as any
/// copy or Motion of it.
class System {
 public:
  static constexpr int most_contacts = 32;

  /// Compiles the model. Cost: about 0.3 ms for the paper's system.
  /// @throws InputError if the model or the option is invalid, or the model has more than `most_contacts`, or time
  /// scales so far apart that its windows cannot be computed in double precision
  explicit System(Model model, SystemOptions options = {});
  System(const System&) = default;  // also where it could be moved: every System stands for a model
  System& operator=(const System&) = default;
  ~System() = default;

  [[nodiscard]] const Model& model() const;
  /// The forcing period in the model's unit of time, or 1 without forcing: the unit of every `Instant`.
  [[nodiscard]] double period() const;
  /// Windows that a period holds in the mode with the shortest ones (of those where nothing is held): about this many
  /// steps are flown in a period without events, and each takes about 0.04 microseconds for the paper's system. Below 1
  /// for a forcing so fast that a window holds several periods.
  [[nodiscard]] double windows_per_period() const;

  /// Modes have the ids 0 .. mode_count() - 1.
  [[nodiscard]] ModeId mode_count() const;
  [[nodiscard]] ModeId mode_id(const mode::ContactStates& states) const;
  [[nodiscard]] mode::ContactStates states(ModeId id) const;
  /// A short name for tables and pictures: "slip+", "slip-", "stick", "free", each followed by "|closed" on a closed
  /// stop and "|on" on a compliant stop that acts.
  [[nodiscard]] std::string mode_name(ModeId id) const;

  /// The name of the contact with this number.
  [[nodiscard]] std::string contact_name(int contact) const;

  /// For the library's own sources: the type is private.
  [[nodiscard]] const flow::CompiledSystem& compiled() const { return *compiled_; }

 private:
  std::shared_ptr<const flow::CompiledSystem> compiled_;
};

}  // namespace slapstick
