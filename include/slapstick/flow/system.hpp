#pragma once
/// A model made ready to run: contact coordinates, its modes with their operators, the impact law. Const and shareable.
#include <cmath>
#include <memory>
#include <vector>

#include "slapstick/flow/mode_table.hpp"

namespace slapstick {

struct SystemOptions {
  /// Windows are no longer than this, in forcing periods (> 0). Events do not depend on it beyond rounding; the work does.
  double longest_window = INFINITY;
};

/// Compiles a model once (about 0.3 ms for the paper's system); any number of `Motion`s on any threads then share it.
///
/// Modes are built when they are first asked for, and kept: of the 2^s 3^f combinations a motion meets a handful. Those of a model with
/// up to eight are built at once, so that its motions allocate nothing.
class System {
 public:
  static constexpr int most_contacts = 32;

  /// @throws InputError if the model or the option is invalid, or the model has more than `most_contacts`, or time scales so far apart that its
  /// windows cannot be computed in double precision.
  explicit System(Model model, SystemOptions options = {});

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const mode::Frame& frame() const { return frame_; }
  [[nodiscard]] double period() const { return period_; }  ///< forcing period, or 1
  /// Windows that a period holds in the mode with the shortest ones (of those where nothing is held): about this many steps are flown in a
  /// period without events, and each takes about 0.04 microseconds for the paper's system. Below 1 for a forcing so fast that a window
  /// holds several periods.
  [[nodiscard]] double windows_per_period() const { return windows_per_period_; }

  [[nodiscard]] ModeId mode_count() const { return mode_count_; }
  /// Safe to call from several threads. @throws InputError as the constructor, about time scales
  [[nodiscard]] const mode::Mode& mode(ModeId id) const {
    const mode::Mode* known = modes_->find(id);
    return known != nullptr ? *known : modes_->get(id, [this](ModeId wanted) { return build(wanted); });
  }
  /// The mode if it has been built, else null; and its system and guards alone, which are cheaper.
  [[nodiscard]] const mode::Mode* known_mode(ModeId id) const { return modes_->find(id); }
  [[nodiscard]] std::shared_ptr<const mode::Outline> outline(ModeId id) const;
  [[nodiscard]] ModeId mode_id(const mode::ContactStates& states) const;
  [[nodiscard]] mode::ContactStates states(ModeId id) const;
  /// A short name for tables and pictures: "slip+", "slip-", "stick", "free", each followed by "|closed" on a closed stop.
  [[nodiscard]] std::string mode_name(ModeId id) const;

  /// Change of u per unit change of the normal velocity of a stop: M^{-1} g^T / (g M^{-1} g^T), g the stop's row.
  [[nodiscard]] const mode::Vector& impulse(int stop) const { return impulses_[stop]; }

  /// Acceleration of a stop's pair towards the stop without any contact force, g . free: a row over X.
  [[nodiscard]] const mode::RowVector& press(int stop) const { return presses_[stop]; }

  /// What a unit friction force of a contact adds to that acceleration, g M^{-1} f^T, and whether both act on one pair at rest to each
  /// other (rows equal or opposite, no belt).
  struct Coupling {
    double effect = 0.0;
    bool same_pair = false;
  };
  [[nodiscard]] const Coupling& coupling(int stop, int friction) const {
    return couplings_[static_cast<std::size_t>(stop) * frame_.frictions.size() + static_cast<std::size_t>(friction)];
  }

  /// Contacts in one numbering: stops first, then friction contacts, then compliant stops.
  [[nodiscard]] std::string contact_name(int contact) const;

 private:
  [[nodiscard]] mode::Mode build(ModeId id) const;

  Model model_;
  mode::Frame frame_;
  SystemOptions options_;
  double period_, windows_per_period_ = 0.0;
  ModeId mode_count_ = 1;
  std::unique_ptr<ModeTable> modes_;
  std::vector<mode::Vector> impulses_;
  std::vector<mode::RowVector> presses_;
  std::vector<Coupling> couplings_;
};

}  // namespace slapstick
