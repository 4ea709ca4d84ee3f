#pragma once
/// Balances that hold in every motion, measured at each event from the model alone.
///
///     "momentum"  law_defect: largest gap, and difference from w+ = -r w-, just after an impact; momentum_defect:
///                 largest change of momentum at an impact of two coordinates, in units of 2^-52 of its parts;
///                 loss_defect: largest difference of the energy lost from m_red (1 - r^2) w^2 / 2, as a share of the
///                 energy
///     "work"      work_defect: largest difference between the change of energy over a segment and the work done on it
///     "reverse"   reverse_defect: largest distance of a segment's start from where its end, flown back in 50 digits,
///                 comes from, in units of 2^-53 |exp(-A s)| max(|X|, 1) a window. docs/developers/proofs.md allows m +
///                 16 of them, m = 2 n + 3 for one harmonic
#include <memory>

#include "catalogue/member.hpp"

namespace slapstick::catalogue {

class Watch {
 public:
  virtual ~Watch() = default;
  virtual void event(const Motion& motion, Values& values) = 0;
};

/// @param system  must outlive it. @throws std::invalid_argument for an unknown kind
std::unique_ptr<Watch> make_watch(const std::string& kind, const System& system);

}  // namespace slapstick::catalogue
