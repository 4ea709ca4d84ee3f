#pragma once
/// Reference solution in 50 digits of models with every law of force: polylines, zones, normal forces, compliant stops,
/// restitution over the speed. For tests only; it shares no code and no method with the engine.
///
/// The state of each contact is read from positions and velocities, whatever happened before. While the states stay the
/// motion is expanded in Taylor series; what keeps them is a polynomial per step, whose first zero is isolated.
///
/// Limits: one friction contact, no mass matrix, any stops with restitution > 0 that do not come to rest, one event at
/// an instant. Nothing may touch a limit without crossing it.
#include <string>

#include "oracle/polynomial.hpp"
#include "slapstick/model/model.hpp"

namespace slapstick::oracle {

class LawOracle {
 public:
  /// @throws std::invalid_argument for models that it does not know
  LawOracle(const Model& model, const Vector& state);

  /// Moves on to t_end. @returns the times of the changes of contact states on the way
  std::vector<Real> run(const Real& t_end);
  [[nodiscard]] Vector state() const;  ///< x1, v1, x2, v2, ...
  [[nodiscard]] const Real& period() const { return period_; }

 private:
  /// k . x + c . v + constant.
  struct Row {
    Vector k, c;
    Real constant = 0;
    bool zero = true;
    void add(const Row& other, const Real& factor);
  };
  /// Of each contact: piece; compliant 0 off, 1 on, 2 detached, 3 bounded; friction -1, 0, 1, 2 unloaded.
  struct Cell {
    std::vector<int> pieces, compliant, frictions;
    bool operator==(const Cell&) const = default;
  };
  /// What an event says about one contact whose limit is exactly zero.
  struct Said {
    enum class Of { nothing, piece, compliant, load, slip } of = Of::nothing;
    std::size_t index = 0;
    int state = 0;
  };
  struct Guard {
    Polynomial p;
    Said after;
    int stop = -1;  ///< the stop that is hit
  };
  /// A force between a and b.
  struct Element {
    int a, b;
    Row row;
  };
  struct Series {
    std::vector<Vector> x, v;
    Polynomial holding;
  };

  [[nodiscard]] Row empty() const;
  [[nodiscard]] Row pair(int a, int b, bool velocity, const Real& factor) const;
  [[nodiscard]] Row value_row(std::size_t i) const;
  [[nodiscard]] Row bent_row(std::size_t i, int piece) const;
  [[nodiscard]] Row compliant_row(std::size_t i, int state) const;
  [[nodiscard]] Row load_row(std::size_t i, const Cell& cell) const;
  [[nodiscard]] Real at(const Row& row) const;
  [[nodiscard]] Polynomial along(const Row& row, const Series& series) const;
  [[nodiscard]] Cell cell_here(const Said& said) const;
  [[nodiscard]] int compliant_state(std::size_t i) const;
  [[nodiscard]] Real holding(const Cell& cell) const;
  [[nodiscard]] std::vector<Element> elements(const Cell& cell) const;
  [[nodiscard]] std::vector<Vector> forcing(const Real& step, std::size_t terms) const;
  [[nodiscard]] Series expand(const Cell& cell, const Real& step, int order) const;
  [[nodiscard]] std::vector<Guard> guards(const Series& series) const;
  void compliant_guards(std::size_t i, const Series& series, std::vector<Guard>& all) const;
  void pull(Vector& force, int a, int b, const Real& value) const;
  void strike(int stop);

  Model model_;
  Vector x_, v_, inverse_mass_;
  Real t_ = 0, period_, step_;
  Cell cell_;
};

}  // namespace slapstick::oracle
