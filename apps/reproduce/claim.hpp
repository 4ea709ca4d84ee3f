#pragma once
/// A claim of the paper, what was computed for it, and whether the two agree.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slapstick::paper {

/// How far a claim and the computation agree. `not_claimed`: found here, the paper says nothing of it.
enum class Agreement { yes, partly, no, not_claimed };

/// "yes", "partly", "no", "not claimed".
std::string_view name(Agreement agreement);

/// One number (or word) of a claim.
struct Quantity {
  std::string name;                ///< "upper edge of the 1-1 window"
  std::string printed;             ///< as the paper has it: "2.84"; empty if the paper gives no number
  std::string computed;            ///< as people read it: "2.8451"
  std::optional<double> value{};   ///< the same as a number, where there is one
  std::string note{};              ///< what lies on either side, how it was found
  std::optional<double> within{};  ///< so far from `value` the true number may be, where that is known
};

/// A claim of the table. `id` is C1 to C9, or "print" for the comparison with the printed
/// restitution, or "coexisting" for the attractors that share a frequency.
struct Claim {
  std::string id;
  std::string printed;   ///< the paper's words, shortened
  std::string computed;  ///< the answer in a sentence or two
  Agreement agreement = Agreement::no;
  std::string explanation;  ///< why, in plain words; where it does not agree, what differs
  std::vector<Quantity> quantities;

  /// The quantity of that name; null if there is no such quantity.
  [[nodiscard]] const Quantity* find(std::string_view quantity) const;
};

}  // namespace slapstick::paper
