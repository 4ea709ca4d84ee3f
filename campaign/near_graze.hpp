#pragma once
/// Starts whose first event is nearly a graze: a guard comes down to +-2^-k of its scale, k = 8 .. 52, and turns back.
#include <vector>

#include "scene.hpp"

namespace campaign {

struct Start {
  slapstick::State state;
  double phase = 0.0;
  int guard = -1;  ///< the one that nearly grazes, or -1: nothing is known of this start
};

/// A random start, of which nothing is known.
Start random_start(const Scene& scene, Random& random);

/// Makes near-grazes of one scene. One number of a random start is moved until a minimum of a guard is where it shall
/// be, up to the rounding of that number; one of four starts in contact, leaving. Most random starts have no minimum
/// that can be had: those that had one are varied.
class NearGrazes {
 public:
  NearGrazes(Scene& scene, Random& random) : scene_(scene), random_(random) {}
  /// False if it did not succeed this time.
  bool next(Start& out);

 private:
  struct Base {
    Start start;
    int knob;         ///< the number of the state that is moved,
    bool in_contact;  ///< that of the approach of the first stop, which begins at zero
  };
  [[nodiscard]] Base fresh() const;
  [[nodiscard]] Base varied() const;
  void touch(Base& base) const;

  Scene& scene_;
  Random& random_;
  std::vector<Base> good_;
};

}  // namespace campaign
