#pragma once
/// --certify F: the run again, written down as a certificate (docs/reference/certificate.md).
#include <string>

#include "io/json.hpp"
#include "output.hpp"
#include "slapstick/certify/certificate.hpp"
#include "verb.hpp"

namespace slapstick::app {

class CertifiedRun {
 public:
  /// @throws StorageError if the file cannot be written
  explicit CertifiedRun(const std::string& path) : output_(path) {}

  /// Runs from `start` to `end`. @returns false if it was stopped: the certificate is then that of the run so far, and
  /// states this itself
  bool operator()(const System& system, const State& start, Instant end, bool progress, const Context& context);
  /// Puts the file in place. @throws StorageError
  void commit() { output_.commit(); }
  [[nodiscard]] Json summary() const;

 private:
  Output output_;
  certify::Tally tally_;
};

}  // namespace slapstick::app
