#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/base/progress.h"
#include "asperity/geometry/pose.h"

namespace asperity::inertial_smoother {

// The error state: position p and velocity v of the accelerometer (world), rotation φ (world,
// R = exp(φ) R̂), accelerometer bias (marker), gyroscope bias (marker; without a gyroscope minus the
// angular rate); then, where they are estimated, the latency, the accelerometer's position in the
// marker and the rotation marker ← sensor.
inline constexpr int kP = 0, kV = 3, kPhi = 6, kBa = 9, kBg = 12, kBase = 15, kMax = 22;
using State = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMax, 1>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMax, kMax>;

// Which constants are estimated, and where they are in the state (-1: not there).
struct Layout {
  int latency = -1;
  int lever = -1;
  int misalignment = -1;
  int size = kBase;
};

struct Nominal {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  Eigen::Vector3d ba = Eigen::Vector3d::Zero();
  Eigen::Vector3d bg = Eigen::Vector3d::Zero();
  double latency = 0.0;  // s, beyond what the epochs' times already take off
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();
  Eigen::Quaterniond misalignment = Eigen::Quaterniond::Identity();
};

// One instant: a probe sample or the time of a tracker pose. Inputs hold there and are linear between.
struct Knot {
  double t = 0.0;  // s
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  double accel_psd = 0.0;  // of the segment that begins here, (m/s²)²/Hz
  double gyro_psd = 0.0;   // (rad/s)²/Hz
  std::int64_t sample = -1;
};

// An epoch ends an interval of knots; most bring a pose, some only keep intervals short.
struct Epoch {
  std::size_t knot = 0;
  std::int64_t pose = -1;  // index in the tracker's stream
};

// The filter at an epoch, after its pose: from here it can go on.
struct Checkpoint {
  Nominal x;
  Square P;
  int refused_in_a_row = 0;  // poses outside the gate
};

struct Problem {
  Layout layout;
  std::vector<Knot> knots;
  std::vector<Epoch> epochs;            // the first is the first knot
  std::vector<Pose> poses;              // of the epochs that have one, by Epoch::pose
  std::vector<double> position_weight;  // per pose, from the residuals of the pass before; in (0, 1]
  std::vector<double> rotation_weight;
  Eigen::Vector3d sigma_position = Eigen::Vector3d::Ones();
  Eigen::Vector3d sigma_rotation = Eigen::Vector3d::Ones();
  double time_sigma = 0.0;
  double gate_chi2 = 16.8;
  bool gate_innovations = true;  // the first pass knows no residuals yet
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  bool gyro_turns_too = true;  // the misalignment is the gyroscope's as well: both on one chip
  double accel_bias_psd = 0.0;
  double gyro_bias_psd = 0.0;
  double process_scale = 1.0;  // on accel_psd; with a gyroscope only there, without also on gyro_bias_psd
  double rate_scale = 1.0;     // on gyro_bias_psd
  Nominal start;
  Square start_covariance;
  int refused_in_a_row = 0;
  std::size_t checkpoint_epoch = 0;  // the epoch that Smoothed::checkpoint is taken at
};

struct Smoothed {
  // At the knots that are probe samples, in their order.
  std::vector<std::int64_t> sample;
  std::vector<Eigen::Vector3d> p, v, omega_world, a;
  std::vector<Eigen::Quaterniond> q;
  // At the poses, by their index: residuals of the smoothed state, world frame; zero weight: not reached.
  std::vector<Eigen::Vector3d> position_residual, rotation_residual;
  // At the epochs.
  std::vector<double> epoch_t;
  std::vector<Eigen::Matrix3d> tip_covariance;
  Nominal first;  // smoothed state at the first epoch
  Nominal last;   // and at the last: its constants are the estimates
  State last_sigma;
  Checkpoint checkpoint;
};

// The weight of a measurement whose normalised square is d2: 1 inside the gate, falling as 1/d⁴.
inline double redescending(double d2, double gate) { return d2 <= gate ? 1.0 : (gate / d2) * (gate / d2); }

// The log-likelihood of the poses under the model (forward pass only; each pose's share bounded, so
// that a flipped one cannot decide).
double log_likelihood(const Problem& problem);

// The filter alone: the likelihood as above, and where it stands after the last epoch.
struct Filtered {
  double log_likelihood = 0.0;
  Checkpoint checkpoint;
};
Filtered filter(const Problem& problem);

// `lever_to_tip` is computed as tip_in_marker − lever with the estimated lever.
Smoothed smooth(const Problem& problem, const Eigen::Vector3d& tip_in_marker, const Observer& observer);

}  // namespace asperity::inertial_smoother
