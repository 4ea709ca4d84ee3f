#pragma once
/// Newton's method and the rate of approach decide whether a motion settles on a cycle near which its points return.
/// docs/explanation/classify.md, section 1, says how.
#include <cmath>
#include <optional>

#include "section/point_record.hpp"
#include "section/return_map.hpp"

namespace slapstick::section {

/// A cycle of the return map that the motion is drawn to, or that it is on where the cycle is one of a family.
struct Cycle {
  Eigen::VectorXd x;                              ///< contact state on the section, representative of its class
  int n = 0;                                      ///< returns
  double duration = 0.0;                          ///< in periods of the clock
  std::vector<std::complex<double>> multipliers;  ///< largest modulus first
  Eigen::VectorXd advance;                        ///< along each translation, per cycle
  double return_distance = 0.0;                   ///< of x from its image, relative to the motion's size
  double approach = 0.0;                          ///< how far the motion itself still was from the cycle
  int family = 0;                                 ///< dimensions of the continuum of cycles that it is a member of
  bool neutral = false;                           ///< the motion is on it, but is not drawn to it
};

struct ConfirmationOptions {
  int most_n = 64;                 ///< longest cycle sought, points
  double widest_round = INFINITY;  ///< of the size: a motion that winds more widely is beside no cycle
  bool free = false;               ///< of a free motion the multiplier 1 along the motion is left out
  /// Whether the approach is seen in the record where the record has it, or by following the motion only; and how near
  /// the cycle the approach has been seen, of the motion's size.
  bool by_record = false;
  double there = 1e-10;
  double tolerance = 1e-10;  ///< return distance of one of a family
  Stop stop = nullptr;
};

/// Asks about one motion at one of its points. What is given must live as long.
class Confirmation {
 public:
  /// @param motion  at the last point of the record
  Confirmation(const ReturnMap& map, const PointRecord& record, const Motion& motion,
               const ConfirmationOptions& options)
      : map_(map), record_(record), motion_(motion), options_(options) {}

  struct Look {
    std::optional<Cycle> cycle;
    int refused_return = 0;  ///< after this many points the motion returned, but is drawn to no cycle; 0: none
  };
  /// The first of the candidates that is a cycle.
  [[nodiscard]] Look first_of(const std::vector<Candidate>& candidates) const;
  /// A short cycle that the motion winds round: it returns to none of its states, but their mean is near the cycle.
  [[nodiscard]] std::optional<Cycle> look_around() const;

 private:
  [[nodiscard]] std::optional<Cycle> confirm(int n) const;
  [[nodiscard]] FixedPoint once_round(FixedPoint found, int& n) const;
  [[nodiscard]] bool on_a_family(const FixedPoint& found, int n) const;
  [[nodiscard]] std::optional<Cycle> drawn_to(int n, const Eigen::VectorXd& start) const;
  [[nodiscard]] Eigen::VectorXd beside(const Eigen::VectorXd& x, int n) const;
  [[nodiscard]] bool closes(const Eigen::VectorXd& x, int length) const;
  [[nodiscard]] std::optional<Cycle> member(int n) const;

  const ReturnMap& map_;
  const PointRecord& record_;
  const Motion& motion_;
  ConfirmationOptions options_;
};

}  // namespace slapstick::section
