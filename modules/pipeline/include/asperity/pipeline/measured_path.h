#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/geometry/motion.h"
#include "asperity/registration/registration_result.h"

namespace asperity {

struct MeasuredPathConfig {
  double spacing_m = 0.25e-3;
  double smoothing_m = 5e-3;

  template <class V>
  void visit(V& v) {
    v.field("spacing_m", spacing_m, "of the points of a scan that are registered", {1e-6, 0.1});
    v.field("smoothing_m", smoothing_m, "length of the path's moving mean that is laid on the mesh at first; 0: none",
            {0.0, 1.0});
  }
};

struct PathPoints {
  MeasuredPath path;
  std::vector<double> sample;  // for each point the mean index of its samples in the motion, rising
};

// The points of a scan for registration (seed §5.4: "uniform, equidistant sampling"): the means of the samples in
// contact over steps of `spacing_m`, so that a rest counts once. `usable` is empty or one a sample. `outward_world`
// is the probe's axis, from the tip to the marker; empty if `tip_in_marker_m` is zero. `sigma_m` is the
// median of the positions' standard deviation per axis, and the slow covariance their mean covariance, both 0 if
// the motion has none; the tip's position in the marker is in neither, but in `tip_sigma_m`.
PathPoints measured_path(const TipMotion& motion, std::span<const char> usable, const Eigen::Vector3d& tip_in_marker_m,
                         const MeasuredPathConfig& config);

// The moving mean of a path over `length_m`, shorter towards its ends and where a step of more than three times the
// median parts it: the relief goes, the mesh's shape stays (a curve of radius R is cut by length²/24R).
MeasuredPath smooth_path(const MeasuredPath& path, double length_m);

}  // namespace asperity
