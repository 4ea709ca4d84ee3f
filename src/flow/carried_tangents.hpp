#pragma once
/// Tangent vectors that follow an engine: the work of TangentMotion, for every owner of an engine.
///
/// Threads: as an engine. Cost: one propagation per column and segment.
#include <Eigen/Core>
#include <vector>

#include "flow/compiled_system.hpp"
#include "slapstick/flow/motion.hpp"

namespace slapstick::flow {

class Engine;

class CarriedTangents {
 public:
  /// @param system  of the engine; must live as long
  explicit CarriedTangents(const CompiledSystem& system);

  /// Takes what the mode at a start holds still out of the tangents. To be called when the engine has been made or
  /// started again, after `set`.
  void begin(const Engine& engine);
  /// After each advance of the engine, with what it has returned.
  void follow(const Engine& engine, Outcome outcome);

  /// 2 n numbers each: the first n displacements, the first n velocities, in contact coordinates.
  [[nodiscard]] Eigen::MatrixXd get() const;
  /// @param engine  as it stands: rates of inner coordinates and of sliders follow from the others
  void set(const Eigen::MatrixXd& tangents, const Engine& engine);

 private:
  void flow(const Motion::Segment& segment);
  void come_to_rest(const Engine& engine);
  void hold(const std::vector<int>& rows, Eigen::Index offset);

  const CompiledSystem* system_;
  Eigen::MatrixXd columns_;  ///< of all d displacements and velocities
  std::vector<double> delta_, next_;
  event::Lanes out_;
  long segments_seen_ = 0;
};

}  // namespace slapstick::flow
