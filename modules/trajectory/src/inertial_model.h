#pragma once

#include <array>

#include <Eigen/Core>

#include "inertial_smoother.h"

// The motion and measurement model of the smoother, linearised (docs/trajectory.md).
namespace asperity::inertial_smoother {

using TopRows = Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, kMax>;
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMax>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix39d = Eigen::Matrix<double, 3, 9>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// What a segment's noise adds to the nominal motion (none in the filter, the smoothed value after it).
struct Noise {
  Vector3d dv = Vector3d::Zero();
  Vector3d dphi = Vector3d::Zero();
  Vector3d dbg = Vector3d::Zero();
};

// The state between two knots, with what its linearisation needs.
struct Step {
  Matrix3d R0;      // at the first knot
  Vector3d A;       // mean of R f over the segment, gravity not in it
  Vector3d a0;      // acceleration at the first knot
  Vector3d w;       // mean of M ω over the segment, biases not in it
  Vector3d omega0;  // at the first knot
};

// The maps marker ← sensor of the two inertial sensors, (1 + E) M.
struct Mounting {
  Matrix3d accel;
  Matrix3d gyro;
  Vector3d gravity;
};

Mounting mounting_of(const Nominal& x, const Problem& problem);

// The densities of a segment with all factors.
double accel_density(const Knot& knot, const Problem& problem);  // the same for each axis
double fast_density_factor(const Problem& problem);              // of Knot::accel_fast
double gyro_density(const Knot& knot, const Problem& problem);
double rate_walk_density(const Problem& problem);

// Moves the nominal state from knot k0 to k1; without `noise` as there was none.
Step advance_state(Nominal& x, const Knot& k0, const Knot& k1, const Mounting& mounting, const Noise* noise);

// Covariance of position and velocity that one component of the acceleration's noise leaves, the same for each axis.
struct NoiseIntegral {
  double pp = 0.0, pv = 0.0, vv = 0.0;
  void add(double white, double dt) {
    pp += dt * (2.0 * pv + dt * vv) + 0.25 * dt * dt * white;
    pv += dt * vv + 0.5 * dt * white;
    vv += white;
  }
};

// The same of noise that is not alike along the axes, as the elements xx, yy, zz, xy, xz, yz.
struct UnevenNoiseIntegral {
  using Elements = Eigen::Matrix<double, 6, 1>;
  Elements pp = Elements::Zero(), pv = Elements::Zero(), vv = Elements::Zero();
  void add(const Elements& white, double dt) {
    pp += dt * (2.0 * pv + dt * vv) + (0.25 * dt * dt) * white;
    pv += dt * vv + (0.5 * dt) * white;
    vv += white;
  }
};

Matrix3d symmetric(const Eigen::Matrix<double, 6, 1>& elements);

// Φ of an interval, summed segment by segment (transition_sum.h): Φ − I has the rows of p, v and φ; the slow error
// decays besides.
struct Transition {
  Vector3d sv = Vector3d::Zero(), sp = Vector3d::Zero();  // ∫A, ∬A: the effect of φ is −[s]×
  Matrix3d g1 = Matrix3d::Zero(), g2 = Matrix3d::Zero();  // ∫R, ∬R: of the accelerometer's bias
  Matrix3d vbg = Matrix3d::Zero(), pbg = Matrix3d::Zero();
  Matrix3d vmu = Matrix3d::Zero(), pmu = Matrix3d::Zero(), phimu = Matrix3d::Zero();
  Matrix39d vEa = Matrix39d::Zero(), pEa = Matrix39d::Zero();  // of the accelerometer's matrix
  Matrix39d phiEg = Matrix39d::Zero(), vEg = Matrix39d::Zero(), pEg = Matrix39d::Zero();
  double T = 0.0;
  std::array<NoiseIntegral, 3> accel;                  // by component, without factors
  UnevenNoiseIntegral fast;                            // sensor axes, which turn little within an interval
  Matrix3d marker_from_sensor = Matrix3d::Identity();  // (1 + E) M of the accelerometer
  std::array<double, 2> turn{};

  TopRows rows(const Layout& layout) const;
  // U X with U of rows() and X with a row a state.
  static TopRows times(const TopRows& U, const Square& X, const Layout& layout);
  double slow_decay(const Problem& problem) const;
  Vector6d slow_noise(const Problem& problem) const;  // variances that it gains

  // The fast component's three integrals, world axes, with its factor.
  struct Fast {
    Matrix3d pp, pv, vv;
  };
  Fast fast_noise(const Problem& problem) const;

  // P ← Φ P Φᵀ + Q, with U of rows().
  void propagate(const Problem& problem, const TopRows& U, Nominal& x, Square& P) const;
  // λ ← Φᵀ λ and Λ ← Φᵀ Λ Φ.
  void propagate_back(const Problem& problem, const TopRows& U, State& lambda, Square& Lambda) const;
  // What λ and Λ at the interval's end say of the components in Q.
  void add_score(const Problem& problem, const State& lambda, const Square& Lambda, NoiseScore& score) const;
};

// The covariance of the first state, the factors of its components in it; and what the adjoint there says of them.
Square start_covariance(const Problem& problem);
void add_start_score(const Problem& problem, const State& lambda, const Square& Lambda, NoiseScore& score);

// Where a stretch begins: the motion's error is its prior, its place tied to the lever, the constants are as they were.
void restart_motion(const Problem& problem, const Restart& restart, Nominal& x, Square& P);
// λ ← Φᵀ λ and Λ ← Φᵀ Λ Φ over it, and what they say of the components in the prior.
void restart_back(const Problem& problem, const Restart& restart, State& lambda, Square& Lambda, NoiseScore& score);

// Adds an error state to the nominal one.
void apply_correction(const State& d, const Layout& layout, Nominal& x);

struct Predicted {
  Vector6d residual;  // measured minus predicted: position, rotation (world)
  Vector6d rate;      // how fast the pose moves
  Matrix3d R;
  Vector3d arm;
  Jacobian jacobian(const Layout& layout) const;
  // H X of a matrix X with a row a state; most of H is zero.
  Jacobian times(const Square& X, const Layout& layout) const;
};

Predicted predict_pose(const Nominal& x, const Vector3d& omega, const Pose& pose);

// A pose's noise with the factors in it: the white part, scaled along each axis, and the time's jitter.
struct MeasurementNoise {
  Matrix3d position, rotation;  // the white part
  Vector6d timing;              // its outer product is the jitter's covariance
  Matrix6d covariance(double position_weight, double rotation_weight) const;
};

MeasurementNoise measurement_noise(const Problem& problem, std::size_t pose, const Vector6d& rate);

}  // namespace asperity::inertial_smoother
