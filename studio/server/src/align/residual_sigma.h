#pragma once

#include <limits>
#include <vector>

#include "align/align_scene.h"
#include "align/path_residuals.h"
#include "asperity/geometry/pose.h"

namespace asperity::studio {

// What the scans state of the distances of their points to the mesh.
struct ResidualSigma {
  std::vector<float> sigma_m;  // standard deviation of each; nan where its scan states none
  double median_m = std::numeric_limits<double>::quiet_NaN();
  double rms = std::numeric_limits<double>::quiet_NaN();  // of distance over σ
};

// σ² = nᵀ R (C + Q diag(t²) Qᵀ) Rᵀ n of a point, n the mesh's normal at it, R the rotation of its scan's pose
// (`T_mesh_world`, one a path), C the mean covariance of the scan's positions, Q the probe's orientation and t the
// standard deviations of the tip in the marker (registration_result.h, MeasuredPath). A path without covariance has its
// σ per axis. The error of the pose and the relief of the surface are not in it.
ResidualSigma residual_sigma(const AlignScene& scene, const PathResiduals& residuals,
                             const std::vector<Pose>& T_mesh_world);

}  // namespace asperity::studio
