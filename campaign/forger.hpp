#pragma once
/// Forgeries of certificates: one claim of a true certificate is changed, left out, doubled or moved.
#include <string>
#include <vector>

#include "random.hpp"

namespace campaign {

struct Forgery {
  std::string kind;  ///< "duration", "impact left out", ..
  std::string text;
};

class Forger {
 public:
  explicit Forger(const std::string& certificate);
  /// The names of all kinds.
  [[nodiscard]] static std::vector<std::string> kinds();
  /// A forgery of the kind, or an empty text where the certificate has nothing of the sort.
  [[nodiscard]] Forgery make(int kind, Random& random) const;

 private:
  std::vector<std::vector<std::string>> lines_;
};

}  // namespace campaign
