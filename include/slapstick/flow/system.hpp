#pragma once
/// A model made ready to run: contact coordinates, all modes with their operators, the impact law. Const and shareable.
#include <vector>

#include "slapstick/mode/mode.hpp"

namespace slapstick {

/// Compiles a model once (about 0.1 ms for the paper's system); any number of `Motion`s on any threads then share it.
class System {
 public:
  /// @throws InputError if the model is invalid, has more than one stop or more than one friction contact, or has time scales so far
  /// apart that its windows cannot be computed in double precision.
  explicit System(Model model);

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const mode::Frame& frame() const { return frame_; }
  [[nodiscard]] double period() const { return period_; }  ///< forcing period, or 1
  /// Windows of the mode with the shortest ones that a period holds: at most this many steps are flown in a period without events, and
  /// each takes about 0.04 microseconds for the paper's system. Below 1 for a forcing so fast that a window holds several periods.
  [[nodiscard]] double windows_per_period() const { return windows_per_period_; }

  [[nodiscard]] int mode_count() const { return static_cast<int>(modes_.size()); }
  [[nodiscard]] const mode::Mode& mode(int id) const { return modes_[id]; }
  [[nodiscard]] int mode_id(const mode::ContactStates& states) const;
  /// A short name for tables and pictures: "slip+", "slip-", "stick", "free", each followed by "|closed" on a closed stop.
  [[nodiscard]] std::string mode_name(int id) const;

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

  /// Contacts in one numbering: stops first, then friction contacts.
  [[nodiscard]] std::string contact_name(int contact) const;

 private:
  Model model_;
  mode::Frame frame_;
  double period_, windows_per_period_ = 0.0;
  std::vector<mode::Mode> modes_;
  std::vector<mode::Vector> impulses_;
  std::vector<mode::RowVector> presses_;
  std::vector<Coupling> couplings_;
};

}  // namespace slapstick
