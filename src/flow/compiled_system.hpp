#pragma once
/// What a System shares: contact coordinates, the modes with their operators, the impact law's vectors. Const except
/// for the table of modes.
#include <memory>
#include <string>
#include <vector>

#include "flow/mode_table.hpp"
#include "slapstick/flow/system.hpp"

namespace slapstick::flow {

/// See System for what it means, costs and throws.
class CompiledSystem {
 public:
  CompiledSystem(Model model, SystemOptions options);

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const mode::Frame& frame() const { return frame_; }
  [[nodiscard]] double period() const { return period_; }
  [[nodiscard]] double windows_per_period() const { return windows_per_period_; }

  [[nodiscard]] ModeId mode_count() const { return mode_count_; }
  /// Of so few a mode is built when a state first asks for it, fit or not; of more, an outline is asked before.
  [[nodiscard]] bool few_modes() const { return mode_count_ <= 8; }
  /// Safe to call from several threads. @throws InputError about time scales
  [[nodiscard]] const mode::Mode& mode(ModeId id) const {
    const mode::Mode* known = modes_->find(id);
    return known != nullptr ? *known : modes_->get(id, [this](ModeId wanted) { return build(wanted); });
  }
  /// The mode if it has been built, else null; and its system and guards alone, which are cheaper.
  [[nodiscard]] const mode::Mode* known_mode(ModeId id) const { return modes_->find(id); }
  [[nodiscard]] std::shared_ptr<const mode::Outline> outline(ModeId id) const;
  [[nodiscard]] ModeId mode_id(const mode::ContactStates& states) const;
  [[nodiscard]] mode::ContactStates states(ModeId id) const;
  [[nodiscard]] std::string mode_name(ModeId id) const;

  /// Change of u per unit change of the normal velocity of a stop: M^{-1} g^T / (g M^{-1} g^T), g the stop's row.
  [[nodiscard]] const mode::Vector& impulse(int stop) const { return impulses_[stop]; }

  /// Acceleration of a stop's pair towards the stop without any contact force, g . free: a row over X.
  [[nodiscard]] const mode::RowVector& press(int stop) const { return presses_[stop]; }

  /// What a unit friction force of a contact adds to that acceleration, g M^{-1} f^T, and whether both act on one pair
  /// at rest to each other (rows equal or opposite, no belt).
  struct Coupling {
    double effect = 0.0;
    bool same_pair = false;
  };
  [[nodiscard]] const Coupling& coupling(int stop, int friction) const {
    return couplings_[static_cast<std::size_t>(stop) * frame_.frictions.size() + static_cast<std::size_t>(friction)];
  }

  [[nodiscard]] std::string contact_name(int contact) const;
  /// Contacts, as contact_name numbers them, are of one group if their forces act on each other's pairs at once, or
  /// through others of the group. @returns one of the group's contacts
  [[nodiscard]] int group(int contact) const { return groups_[static_cast<std::size_t>(contact)]; }
  /// How many states a friction contact or a compliant stop can be in.
  [[nodiscard]] int friction_states(std::size_t i) const { return model_.frictions[i].normal ? 4 : 3; }
  [[nodiscard]] int compliant_states(std::size_t i) const { return model_.compliant_stops[i].bounded ? 4 : 3; }
  /// No mode has more guards.
  [[nodiscard]] int most_guards() const {
    return static_cast<int>(1 + model_.stops.size() + 3 * model_.frictions.size() +
                            2 * (model_.compliant_stops.size() + model_.characteristics.size()));
  }

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
  std::vector<int> groups_;
};

}  // namespace slapstick::flow
