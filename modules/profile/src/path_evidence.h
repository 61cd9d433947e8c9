#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/profile/find_base_path.h"
#include "even_path.h"

namespace asperity {

// What the fits of the base shape work on.
struct PathEvidence {
  EvenPath<3> path;                         // the tip at 200 Hz or less
  std::vector<double> weight;               // distance travelled in contact in each cell
  std::vector<Eigen::Vector3d> probe_axis;  // unit, tip towards marker, of each cell; zero if unknown
  std::vector<double> travelled_m;          // sum of the weights before each cell
  double moving_s = 0.0;
  bool force_measured = false;

  // Means over windows that reach over the texture, spaced by half a window along the path.
  std::vector<Eigen::Vector3d> coarse_m;
  std::vector<Eigen::Vector3d> coarse_axis;     // mean probe axis, not normalised
  std::vector<Eigen::Matrix3d> coarse_fine_m2;  // second moments of the fine motion across the path
  double independent = 0.0;                     // number of coarse points with independent errors
};

// `t_s` rise; `contact` has one mark a sample.
PathEvidence gather_evidence(const TipMotion& motion, std::span<const double> t_s, std::span<const char> contact,
                             const Eigen::Vector3d& tip_in_marker_m, const BasePathConfig& config);

}  // namespace asperity
