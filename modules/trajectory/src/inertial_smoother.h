#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/base/progress.h"
#include "asperity/geometry/pose.h"
#include "knot_line.h"
#include "noise_components.h"

namespace asperity::inertial_smoother {

// The error state: position p and velocity v of the accelerometer (world), rotation φ (world,
// R = exp(φ) R̂), accelerometer bias (marker), gyroscope bias (marker; without a gyroscope minus the
// angular rate); then, where they are estimated, what Layout lists.
inline constexpr int kP = 0, kV = 3, kPhi = 6, kBa = 9, kBg = 12, kBase = 15, kMax = 49;
using State = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMax, 1>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMax, kMax>;

// Which further quantities are estimated, and where they are in the state (-1: not there).
struct Layout {
  int latency = -1;
  int lever = -1;         // the accelerometer's position in the marker
  int misalignment = -1;  // the rotation marker ← sensor
  int accel_matrix = -1;  // 9, by columns: the true specific force is (1 + E) times the calibrated one
  int gyro_matrix = -1;   // likewise
  int gravity = -1;       // what the stated gravity lacks, world
  int slow = -1;          // 6, the tracker's slow error: position, rotation, world
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
  Eigen::Matrix3d accel_matrix = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d gyro_matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 6, 1> slow = Eigen::Matrix<double, 6, 1>::Zero();
};

// An epoch ends an interval of knots; most bring a pose, some only keep intervals short.
struct Epoch {
  std::size_t knot = 0;
  std::int64_t pose = -1;  // index in the tracker's stream
};

// A pose's white noise as stated, world axes.
struct PoseNoise {
  Eigen::Matrix3d position_m2 = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d rotation_rad2 = Eigen::Matrix3d::Identity();
};

// The epoch of a problem made of several stretches where a new one begins: the motion begins anew about this pose, the
// constants go on.
struct Restart {
  std::size_t epoch = 0;
  Pose pose;
};

// Whether the two streams are of one motion: deviations that no prior allows for, by generalised least squares under
// the model with the learnt noise. nan: the data say nothing of it.
struct StreamAgreement {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  // The tracker's positions are (1 + scale) times those that the inertial sensors show.
  double scale = kUnknown;
  double scale_sigma = kUnknown;
  double axes_chi2 =
      kUnknown;  // they are (1 + M) times: the normalised square of M, 1 % an element allowed for, 9 degrees of freedom
  // The tracker is later than the prior says, s; the prior's error is in the sigma.
  double latency_s = kUnknown;
  double latency_sigma_s = kUnknown;
  // By how much it becomes later from the first pose to the last, by a straight line, s.
  double latency_change_s = kUnknown;
  double latency_change_sigma_s = kUnknown;
  // The specific force is (1 + E) times the calibrated one: the normalised square of E likewise, with the prior's error
  // in its covariance; 9 degrees of freedom.
  double accel_axes_chi2 = kUnknown;
  double gyro_axes_chi2 = kUnknown;  // the same of the angular rate
  // Where axes_chi2 knows an element of M to worse than 15 %: the log-likelihood that the best other convention of the
  // tracker's axes gains (axes_hypotheses.h).
  double other_axes_log_ratio = kUnknown;
};

// The filter at an epoch, after its pose: from here it can go on.
struct Checkpoint {
  Nominal x;
  Square P;
  int refused_in_a_row = 0;  // poses outside the gate
};

struct Problem {
  Layout layout;
  KnotLine knots;
  std::vector<Epoch> epochs;            // the first is the first knot
  std::vector<Pose> poses;              // of the epochs that have one, by Epoch::pose
  std::vector<PoseNoise> pose_noise;    // per pose
  std::vector<Restart> restarts;        // in order of their epochs
  std::vector<double> position_weight;  // per pose, from the residuals of the pass before; 0: by its innovation
  std::vector<double> rotation_weight;
  double time_sigma = 0.0;
  double gate_chi2 = 16.8;
  bool gate_innovations = true;  // all: the first pass knows no residuals yet
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  bool gyro_turns_too = true;  // the misalignment is the gyroscope's as well: both on one chip
  double accel_bias_psd = 0.0;
  double gyro_bias_psd = 0.0;
  Factors factors = kUnitFactors;
  double process_scale = 1.0;  // besides, on all of the accelerometer's noise; without a gyroscope also on the rate's
  Eigen::Matrix<double, 6, 1> slow_sigma = Eigen::Matrix<double, 6, 1>::Zero();  // m, rad
  double slow_time_s = 1.0;
  Eigen::Vector3d tip_sigma_m = Eigen::Vector3d::Zero();  // of the tip in the marker, marker axes
  Nominal start;
  Square start_covariance;    // without the factors of its components
  Square restart_covariance;  // likewise, the place not tied to the lever
  int refused_in_a_row = 0;
  std::size_t checkpoint_epoch = 0;  // the epoch that Smoothed::checkpoint is taken at
};

struct Smoothed {
  // At the knots that are probe samples, in their order.
  std::vector<std::int64_t> sample;
  std::vector<Eigen::Vector3d> p, v, omega_world, a;
  std::vector<Eigen::Quaterniond> q;
  // At the poses, by their index: residuals of the smoothed state, world frame; zero: not reached.
  std::vector<Eigen::Vector3d> position_residual, rotation_residual;
  // Their normalised squares, by the whole noise that the model gives them.
  std::vector<double> position_chi2, rotation_chi2;
  NoiseScore score;
  // At the epochs.
  std::vector<double> epoch_t;
  std::vector<Eigen::Matrix3d> tip_covariance;
  Nominal first;  // smoothed state at the first epoch
  Nominal last;   // and at the last: its constants are the estimates
  State last_sigma;
  Checkpoint checkpoint;
  StreamAgreement agreement;  // with `path`
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
Filtered filter_motion(const Problem& problem);

// `lever_to_tip` is computed as tip_in_marker − lever with the estimated lever. Without `path` the states at the
// samples and the covariances are left out: residuals, score and constants cost less. With it the problem has no
// restarts.
Smoothed smooth_motion(const Problem& problem, const Eigen::Vector3d& tip_in_marker, bool path,
                       const Observer& observer);

}  // namespace asperity::inertial_smoother
