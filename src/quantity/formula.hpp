#pragma once
/// A quantity in one mode: a polynomial of degree two in the extended state X (mode/frame.hpp).
///
///     q = linear . X + sum_k (left_k . X) (right_k . X)
///
/// Where a closed stop and sticking friction hold one pair, only the sum f0 of their forces is determined. The split is
/// the one with the least press: friction bears f0 up to its static limit, the stop what is beyond it. So a force has a
/// kink where f0 passes the limit, which is no event: `kinks` are the rows whose zeros those are, and `sides` says on
/// which side of its kinks each pair is. Contacts that hold a pair together share the force as each can bear in its
/// sense; with a freewheel among them that is a kink too. Rows have their derivatives by a parameter beside them.
#include <optional>
#include <utility>
#include <vector>

#include "mode/held.hpp"
#include "mode/outline.hpp"
#include "quantity/varied.hpp"
#include "slapstick/quantity/quantity.hpp"

namespace slapstick::quantity {

struct Formula {
  Row linear;
  std::vector<std::pair<Row, Row>> products = {};
};

/// What the quantities of a mode are made of. Refers to its arguments.
class Formulas {
 public:
  /// @param rates  of the parameter that derivatives are by, with its outline; null: derivatives are zero
  Formulas(const Model& model, const mode::Frame& frame, const mode::Outline& outline, const Rates* rates = nullptr);

  /// The rows whose zeros are kinks; `sides` from their values at an X (Kink order).
  [[nodiscard]] const std::vector<Row>& kinks() const { return kinks_; }
  /// @param above  of each kink, whether its row is positive
  [[nodiscard]] Formula of(const Quantity& quantity, const std::vector<bool>& above) const;

  /// The tail of a complete chatter is flown with its stops closed (flow/chatter.hpp), but a stop pushes at impacts
  /// only. What the friction of its pair bears in the mean, from the tail's start at X on ..
  struct Borne {
    int stop;
    Number all = {};
    std::vector<Number> of = {};  ///< of each friction contact of the pair, in the order of HeldPair
  };
  [[nodiscard]] Borne borne_in_chatter(int stop, const Vector& X, const Vector& by) const;
  /// .. the mean push of its impacts as a row over X ..
  [[nodiscard]] Row press_in_chatter(const Borne& borne) const;
  /// .. a quantity between the impacts, and what it has of the impulses of one stop.
  /// @param chatter  of each stop that chatters
  [[nodiscard]] Formula in_chatter(const Quantity& quantity, const std::vector<bool>& above,
                                   const std::vector<Borne>& chatter) const;
  [[nodiscard]] Number share_in_chatter(const Quantity& quantity, int stop) const;

  /// Row over X of a coordinate's displacement and velocity, of a contact's velocity.
  [[nodiscard]] Row displacement(int coordinate) const;
  [[nodiscard]] Row velocity(int coordinate) const;
  [[nodiscard]] Row relative(int contact) const;

 private:
  struct Kink {
    std::size_t pair;
    double side;  ///< f0 beyond the limit on this side; 0: the sense of what contacts bear together
  };

  [[nodiscard]] RowVector zero() const { return RowVector::Zero(frame_.size()); }
  [[nodiscard]] Row none() const { return still(zero()); }
  [[nodiscard]] Row one() const { return still(RowVector::Unit(frame_.size(), frame_.one())); }
  [[nodiscard]] Row still(RowVector row) const { return {std::move(row), zero()}; }
  [[nodiscard]] Row moved(RowVector row) const;
  /// A number of a part of the model, and its derivative.
  template <class Part>
  [[nodiscard]] Number number(const std::vector<Part> Model::*parts, int i, double Part::*member) const {
    const auto at = static_cast<std::size_t>(i);
    return {(model_.*parts)[at].*member, rates_ ? (rates_->model.*parts)[at].*member : 0.0};
  }
  [[nodiscard]] Row load(int friction) const;
  [[nodiscard]] Row constant_part(int friction) const;
  [[nodiscard]] Number kinetic_at(int friction, const Vector& X, const Vector& by) const;
  [[nodiscard]] Row limit(const mode::HeldPair& pair) const;
  [[nodiscard]] Row holding(std::size_t pair) const;
  [[nodiscard]] Number shared_friction(const mode::HeldPair& pair) const;
  [[nodiscard]] std::size_t pair_of(int stop) const;
  [[nodiscard]] Number moved_by(int stop, int coordinate) const;
  [[nodiscard]] Number single_share(const Quantity& quantity, int index, int stop) const;
  [[nodiscard]] Row single_in_chatter(const Quantity& quantity, int index, const std::vector<bool>& above,
                                      const std::vector<Borne>& chatter) const;
  [[nodiscard]] std::optional<Row> friction_in_chatter(int friction, const Borne& borne) const;
  [[nodiscard]] Formula single(const Quantity& quantity, int index, const std::vector<bool>& above) const;
  [[nodiscard]] Row acceleration(int coordinate) const;
  [[nodiscard]] Row gap(int contact) const;
  [[nodiscard]] Row force(int contact, const std::vector<bool>& above) const;
  [[nodiscard]] Row held_stop(int stop, const std::vector<bool>& above) const;
  [[nodiscard]] Row held_friction(int friction, const std::vector<bool>& above) const;
  [[nodiscard]] Row bend_force(int characteristic) const;
  [[nodiscard]] Row drive(int force) const;
  template <class Link>
  [[nodiscard]] Row link_force(const Link& link, Number strength, bool velocities) const;
  [[nodiscard]] Row spring_force(int spring) const;
  [[nodiscard]] Row damper_force(int damper) const;
  [[nodiscard]] Row link_speed(int link) const;
  [[nodiscard]] double beyond(std::size_t pair, const std::vector<bool>& above) const;
  [[nodiscard]] double borne_sense(std::size_t pair, const std::vector<bool>& above) const;
  [[nodiscard]] bool shares_by_sense(const mode::HeldPair& pair) const;
  [[nodiscard]] Row borne(const mode::HeldPair& pair, std::size_t index) const;
  [[nodiscard]] Number room(const mode::HeldPair& pair, int friction, double along) const;
  [[nodiscard]] Row shared_by_sense(int friction, std::size_t index, const std::vector<bool>& above) const;
  [[nodiscard]] double sense(const mode::HeldPair& pair, const mode::ContactRow& contact) const;
  template <class Link>
  [[nodiscard]] Row difference(const Link& link, bool velocities) const {
    Row row = none();
    const auto of = [&](int end) { return velocities ? velocity(end) : displacement(end); };
    if (link.a != ground) row += link.ratio.a * of(link.a);
    if (link.b != ground) row -= link.ratio.b * of(link.b);
    if constexpr (requires { link.inner; })
      if (link.inner >= 0) row -= of(link.inner);
    return row;
  }
  [[nodiscard]] Formula power(int contact, const std::vector<bool>& above) const;
  [[nodiscard]] Formula damping() const;
  [[nodiscard]] Formula input(const std::vector<bool>& above) const;
  [[nodiscard]] Formula kinetic() const;
  [[nodiscard]] Formula potential() const;
  [[nodiscard]] Number energy_offset(int characteristic, int piece) const;
  void add_bend(int characteristic, Formula& energy) const;

  [[nodiscard]] int stops() const { return static_cast<int>(model_.stops.size()); }
  [[nodiscard]] int frictions() const { return static_cast<int>(model_.frictions.size()); }
  [[nodiscard]] int compliants() const { return static_cast<int>(model_.compliant_stops.size()); }
  [[nodiscard]] int bends() const { return static_cast<int>(model_.characteristics.size()); }
  [[nodiscard]] int springs() const { return static_cast<int>(model_.springs.size()); }

  const Model& model_;
  const mode::Frame& frame_;
  const mode::Outline& outline_;
  std::optional<Rates> rates_;
  std::vector<mode::HeldPair> held_;
  std::vector<Kink> kink_of_;
  std::vector<Row> kinks_;
};

}  // namespace slapstick::quantity
