/// Tangent vectors along a motion: what flow/carried_tangents.hpp carries along its engine.
#include "slapstick/flow/tangent.hpp"

#include "flow/carried_tangents.hpp"
#include "flow/engine.hpp"

namespace slapstick {

struct TangentMotion::Parts {
  Parts(const System& system, const State& state, const Eigen::MatrixXd& tangents, Instant start, MotionOptions options)
      : motion(system, state, start, options), carried(motion.system().compiled()) {
    carried.set(tangents, motion.engine());
    carried.begin(motion.engine());
  }

  Motion motion;
  flow::CarriedTangents carried;
};

TangentMotion::TangentMotion(const System& system, const State& state, const Eigen::MatrixXd& tangents, Instant start,
                             MotionOptions options)
    : parts_(std::make_unique<Parts>(system, state, tangents, start, options)) {}

TangentMotion::TangentMotion(const TangentMotion& other) : parts_(std::make_unique<Parts>(*other.parts_)) {}
TangentMotion::TangentMotion(TangentMotion&& other) noexcept = default;
TangentMotion& TangentMotion::operator=(TangentMotion&& other) noexcept = default;
TangentMotion::~TangentMotion() = default;
TangentMotion& TangentMotion::operator=(const TangentMotion& other) {
  if (this != &other) *this = TangentMotion(other);
  return *this;
}

Outcome TangentMotion::advance(Instant end) {
  const Outcome outcome = parts_->motion.advance(end);
  parts_->carried.follow(parts_->motion.engine(), outcome);
  return outcome;
}
const Motion& TangentMotion::motion() const { return parts_->motion; }
Eigen::MatrixXd TangentMotion::tangents() const { return parts_->carried.get(); }
void TangentMotion::set_tangents(const Eigen::MatrixXd& tangents) {
  parts_->carried.set(tangents, parts_->motion.engine());
}

}  // namespace slapstick
