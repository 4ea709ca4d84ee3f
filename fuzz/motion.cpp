/// Bytes as the numbers of a small model and its start: whatever `validate` admits can be compiled and flown, or is
/// refused for its time scales.
#include <array>

#include "flight.hpp"
#include "target.hpp"

namespace slapstick::fuzz {
namespace {

/// Takes what the bytes say, and zeros after their end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : text_(text_of(data, size)) {}

  int below(int count) { return next() % count; }

  /// Half of all bytes are multiples of 1/16 in [-4, 4), the others numbers that are known for trouble.
  double number() {
    static constexpr std::array<double, 32> awkward = {0.0,
                                                       -0.0,
                                                       1e-50,
                                                       1e-30,
                                                       1e-16,
                                                       1e-12,
                                                       1e-8,
                                                       1e-4,
                                                       1e-2,
                                                       0.1,
                                                       1.0 / 3,
                                                       1 - 0x1p-53,
                                                       1.0,
                                                       10.0,
                                                       1e2,
                                                       1e4,
                                                       1e8,
                                                       1e12,
                                                       1e16,
                                                       1e30,
                                                       1e50,
                                                       1e51,
                                                       1 + 0x1p-52,
                                                       0x1p-1074,
                                                       -1.0,
                                                       -0.1,
                                                       -1e-8,
                                                       -1e-16,
                                                       -1e8,
                                                       -1e50,
                                                       3.141592653589793,
                                                       1e300};
    const int byte = next();
    return byte < 128 ? byte / 16.0 - 4.0 : awkward[static_cast<std::size_t>(byte) % awkward.size()];
  }

 private:
  std::uint8_t next() {
    if (text_.empty()) return 0;
    const auto byte = static_cast<std::uint8_t>(text_[0]);
    text_.remove_prefix(1);
    return byte;
  }
  std::string_view text_;
};

/// A coordinate, or the ground.
int end(Bytes& bytes, int n) { return bytes.below(n + 1) - 1; }

Model model_of(Bytes& bytes) {
  Model model;
  model.name = "fuzz";
  const int n = 1 + bytes.below(3);
  for (int i = 0; i < n; ++i) model.coordinates.push_back({"x" + std::to_string(i + 1), bytes.number()});
  model.omega = bytes.number();
  if (bytes.below(2) == 1) model.impact_law = ImpactLaw::sequence;
  for (int i = bytes.below(4); i > 0; --i) {
    const int a = end(bytes, n), b = end(bytes, n);
    model.springs.push_back({a, b, bytes.number()});
    model.dampers.push_back({a, b, bytes.number()});
  }
  for (int i = bytes.below(3); i > 0; --i) {
    const int on = bytes.below(n), harmonic = bytes.below(3);
    const double amplitude = bytes.number();
    model.forces.push_back({on, harmonic, amplitude, bytes.number()});
  }
  for (int i = bytes.below(3); i > 0; --i) {
    const int a = end(bytes, n), b = end(bytes, n);
    const double belt = bytes.number(), limit = bytes.number();
    model.frictions.push_back(
        {"f" + std::to_string(i), a, b, belt, limit, bytes.below(2) == 0 ? limit : bytes.number()});
  }
  for (int i = bytes.below(3); i > 0; --i) {
    const int a = end(bytes, n), b = end(bytes, n);
    const double clearance = bytes.number();
    model.stops.push_back({"s" + std::to_string(i), a, b, clearance, bytes.number()});
  }
  for (int i = bytes.below(2); i > 0; --i) {
    const int a = end(bytes, n), b = end(bytes, n);
    const double clearance = bytes.number(), stiffness = bytes.number(), damping = bytes.number();
    model.compliant_stops.push_back(
        {"c" + std::to_string(i), a, b, clearance, stiffness, damping, bytes.below(2) == 1});
  }
  return model;
}

}  // namespace
}  // namespace slapstick::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slapstick;
  using namespace slapstick::fuzz;
  Bytes bytes(data, size);
  Model model = model_of(bytes);
  State start(static_cast<std::size_t>(2 * model.size()));
  for (double& number : start) number = bytes.number();
  (void)succeeds([&] {
    validate(model);
    fly(System(std::move(model)), start);
  });
  return 0;
}
