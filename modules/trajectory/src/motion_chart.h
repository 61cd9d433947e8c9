#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/trajectory/object_motion.h"

// Position or rotation of a body under white acceleration, filtered and smoothed from poses (smooth_object_motion.h).
// The state is the value and its rate, world axes; the errors are additive in position and rates, and R = exp(φ) R̂.
namespace asperity::motion_chart {

enum class ChartKind { kPosition, kRotation };

struct Measured {
  std::vector<double> t_s;  // rises strictly
  std::vector<Pose> poses;
  std::vector<Eigen::Matrix3d> variance;  // of the poses, as stated
  std::size_t first = 0;                  // the pose that the motion begins at
};

struct Path {
  std::vector<Pose> pose;  // of which the chart's part counts
  std::vector<ObjectKnot> knots;
  std::vector<double> chi2;  // squared distance of the poses from the smoothed path, in their noise
};

// `density` of the white acceleration, two-sided, and factors on the poses' variances, each along its axis; weights of
// the poses. With `gate_chi2` above 0 poses lose weight by their innovation as well.
Path smooth(ChartKind kind, const Measured& measured, const Eigen::Vector3d& density,
            const Eigen::Vector3d& noise_factor, const std::vector<double>& weight, double gate_chi2);

// Of each axis, zᵀV⁻¹VᵢV⁻¹z and tr V⁻¹Vᵢ for Vᵢ what θᵢ stands for, as in docs/trajectory-noise.md: by their ratio a
// density (or a factor on the poses' variances) grows.
struct Learnt {
  Eigen::Vector3d density_seen = Eigen::Vector3d::Zero(), density_expected = Eigen::Vector3d::Zero();
  Eigen::Vector3d noise_seen = Eigen::Vector3d::Zero(), noise_expected = Eigen::Vector3d::Zero();
};
Learnt learn(ChartKind kind, const Measured& measured, const Path& path, const Eigen::Vector3d& density,
             const Eigen::Vector3d& noise_factor, const std::vector<double>& weight);

}  // namespace asperity::motion_chart
