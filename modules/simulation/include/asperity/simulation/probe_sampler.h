#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/recording/recording.h"
#include "asperity/simulation/gauss_markov.h"
#include "asperity/simulation/low_pass.h"
#include "asperity/simulation/probe_motion.h"

namespace asperity {

// Turns the true motion into the probe's samples, state by state. The rigid body's motion is
// differentiated on the integration's grid: the acceleration at the sensor is the second difference of its
// position, so the lever arm's terms are in it.
class ProbeSampler {
 public:
  // `truth` holds the sensors' true model; time stamps begin at `start_ns`.
  ProbeSampler(const SimulationConfig& config, const Calibration& truth, std::int64_t start_ns);

  void push(const MotionState& state);
  // After the last state: what is still on its way arrives.
  void finish();

  ProbeStream samples;  // what reached the host
  Truth truth;          // one row for each sample that was taken, at its true time

 private:
  struct Kinematics {
    MotionState state;
    Eigen::Vector3d p_world_sensor_m = Eigen::Vector3d::Zero();
  };
  struct Signal {
    double t_s = 0.0;
    Eigen::Vector3d specific_force_mps2 = Eigen::Vector3d::Zero();
    Eigen::Vector3d omega_radps = Eigen::Vector3d::Zero();
    double force_N = 0.0;
    Eigen::Vector3d force3_N = Eigen::Vector3d::Zero();
  };
  void take(const Signal& signal, const MotionState& before, const MotionState& after, double share);
  double count(double value) const;
  Eigen::Vector3d slow_accel_mps2(double t_s);
  std::int64_t stamp_ns(double t_s);
  void end_batch(double t_s);

  SimulatedProbeConfig config_;
  Calibration calibration_;
  Eigen::Vector3d gravity_world_mps2_;
  Eigen::Vector3d force_axis_in_marker_;
  std::int64_t start_ns_ = 0;
  double step_s_ = 0.0;
  std::int64_t pushed_ = 0;
  std::int64_t taken_ = 0;
  std::int64_t lost_left_ = 0;
  double force_phase_ = 1.0;
  std::int64_t last_stamp_ns_ = 0;
  std::vector<std::int64_t> batch_;  // for each sample of the batch that was kept: how many were taken before it
  std::int64_t batch_first_ = 0;     // of all samples taken
  Kinematics previous_, current_;
  Signal last_signal_;
  SensorLowPass<Eigen::Vector3d> accel_low_pass_, gyro_low_pass_;
  SensorLowPass<double> force_low_pass_;
  SensorLowPass<Eigen::Vector3d> force3_low_pass_;
  Random accel_noise_, gyro_noise_, force_noise_, clock_, radio_;
  Random wander_random_, flicker_random_, force3_noise_;
  GaussMarkov wander_;
  std::array<FlickerNoise, 3> accel_flicker_, gyro_flicker_;
  Eigen::Vector3d warming_mps2_ = Eigen::Vector3d::Zero();
};

}  // namespace asperity
