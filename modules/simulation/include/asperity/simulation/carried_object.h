#pragma once

#include "asperity/geometry/pose.h"
#include "asperity/simulation/probe_motion.h"
#include "asperity/simulation/simulation_config.h"
#include "asperity/simulation/uniform_spline.h"

namespace asperity {

// The object in the other hand (docs/virtual-bench.md): drift, tremor and rotation about the middle of the stroke, a
// cubic spline over time and so twice continuously differentiable. At the time 0 the object is where it is without.
class CarriedObject {
 public:
  // Throws Error for a tremor whose band is empty.
  CarriedObject(const SimulationConfig& config, double duration_s);

  // From where the object was at the time 0, to where it is.
  Pose T_world_start(double t_s) const;
  // The marker body on it.
  Pose T_world_body(double t_s) const { return T_world_start(t_s) * T_start_body_; }
  const Pose& T_start_body() const { return T_start_body_; }

  // A probe that follows: `state` was on the object at rest.
  MotionState carry(MotionState state) const;
  // The body, as a state whose tip is its origin.
  MotionState body_state(double t_s) const;

 private:
  Eigen::Vector3d pivot_m_;
  Pose T_start_body_;
  UniformSpline<6> path_;  // shift of the pivot, m, and rotation vector, world axes
};

}  // namespace asperity
