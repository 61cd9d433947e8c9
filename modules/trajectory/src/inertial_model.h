#pragma once

#include <Eigen/Core>

#include "inertial_smoother.h"

// The motion and measurement model of the smoother, linearised (docs/trajectory.md).
namespace asperity::inertial_smoother {

using TopRows = Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, kMax>;
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMax>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// What a segment's noise adds to the nominal motion (zero in the filter, the smoothed value after it).
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

// The rotations marker ← sensor of the two inertial sensors.
struct Mounting {
  Matrix3d accel;
  Matrix3d gyro;
};

Mounting mounting_of(const Nominal& x, const Problem& problem);

// Moves the nominal state from knot k0 to k1.
Step advance(Nominal& x, const Knot& k0, const Knot& k1, const Mounting& mounting, const Vector3d& gravity,
             const Noise& noise);

// Φ − I of an interval, summed segment by segment: only the rows of p, v and φ differ from zero.
struct Transition {
  Vector3d sv = Vector3d::Zero(), sp = Vector3d::Zero();  // ∫A, ∬A: the effect of φ is −[s]×
  Matrix3d g1 = Matrix3d::Zero(), g2 = Matrix3d::Zero();  // ∫R, ∬R: of the accelerometer's bias
  Matrix3d vbg = Matrix3d::Zero(), pbg = Matrix3d::Zero();
  Matrix3d vmu = Matrix3d::Zero(), pmu = Matrix3d::Zero(), phimu = Matrix3d::Zero();
  double T = 0.0;
  double qpp = 0.0, qpv = 0.0, qvv = 0.0, qphi = 0.0;

  void extend(const Step& s, const Knot& k0, const Knot& k1, const Mounting& mounting, const Problem& problem);
  TopRows rows(const Layout& layout) const;
  void add_noise(const Problem& problem, Square& P) const;
};

// Adds an error state to the nominal one.
void apply(const State& d, const Layout& layout, Nominal& x);

struct Predicted {
  Vector6d residual;  // measured minus predicted: position, rotation (world)
  Jacobian H;
  Vector3d v_marker;
};

Predicted predict_pose(const Nominal& x, const Vector3d& omega, const Pose& pose, const Layout& layout);

}  // namespace asperity::inertial_smoother
