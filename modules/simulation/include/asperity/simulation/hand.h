#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/simulation/hand_config.h"
#include "asperity/simulation/random_wave.h"

namespace asperity {

// The hand's target at one instant.
struct HandState {
  double t_s = 0.0;
  double s_m = 0.0;                                        // where along the path
  double v_mps = 0.0;                                      // its rate
  double along_m = 0.0;                                    // tremor along the path, on top of s
  double force_N = 0.0;                                    // normal set-point; 0 while lifted
  double lift_m = 0.0;                                     // height above where the hand would rest
  double tremor_m = 0.0;                                   // along the normal
  double lateral_m = 0.0;                                  // across the path
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  // small rotation on top of the mean tilt
  bool lifting = false;
};

// The hand's intention, one state a step: rest, the path with slowly varying speed, rest.
class Hand {
 public:
  // `length_m` is the whole path's. Deterministic from `seed`.
  Hand(const HandConfig& config, double length_m, double step_s, std::uint64_t seed);

  HandState next();

  double duration_s() const { return duration_s_; }
  double start_s() const { return config_.rest_s; }  // of the stroke
  double end_s() const { return config_.rest_s + stroke_s_; }
  // Beginnings of the lifts; each takes lift_s.
  const std::vector<double>& lift_off_starts_s() const { return lift_starts_s_; }
  double greatest_force_N() const;

 private:
  double speed(double t_s, double variation) const;
  // 1 while travelling, 0 in a pause, with ramps between.
  double between_pauses(double t_s) const;

  HandConfig config_;
  double step_s_ = 0.0;
  double stroke_s_ = 0.0;
  double duration_s_ = 0.0;
  double speed_scale_ = 1.0;
  std::int64_t index_ = 0;
  double s_m_ = 0.0;
  std::vector<double> lift_starts_s_, pause_starts_s_;
  RandomWave speed_wave_, force_wave_, lateral_wave_, normal_wave_, along_wave_;
  std::array<RandomWave, 3> rotation_wander_, rotation_tremor_;
};

}  // namespace asperity
