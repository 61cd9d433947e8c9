#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/profile/find_base_path.h"
#include "even_path.h"

namespace asperity {

// The cells of a Hann window over the distance travelled, of one pass: a mean over a lift would lie on no surface.
struct CoarseWindow {
  std::size_t begin = 0, end = 0;
  double centre_m = 0.0, width_m = 0.0;  // of the distance travelled
};

// What the fits of the base shape work on.
struct PathEvidence {
  EvenPath<3> path;                         // the tip at 200 Hz or less
  std::vector<double> weight;               // distance travelled in contact in each cell
  std::vector<Eigen::Vector3d> probe_axis;  // unit, tip towards marker, of each cell; zero if unknown
  std::vector<double> travelled_m;          // sum of the weights before each cell
  double moving_s = 0.0;
  bool force_measured = false;

  // Means over windows that reach over the texture, spaced by half a window along the path.
  std::vector<CoarseWindow> windows;
  std::vector<Eigen::Vector3d> coarse_m;
  std::vector<Eigen::Vector3d> coarse_axis;     // mean probe axis, not normalised
  std::vector<Eigen::Matrix3d> coarse_fine_m2;  // second moments of the fine motion across the path
  double independent = 0.0;                     // number of coarse points with independent errors

  // A cell's weight in a window: the distance that was travelled in it times the window's.
  double weight_in(const CoarseWindow& window, std::size_t cell) const;
};

// The mean square of the windows' means of what cells depart by. A mean of points on a curved surface would not be on
// it.
template <class Departure>
double square_of_means(const PathEvidence& evidence, const Departure& departure_m) {
  double out = 0.0;
  for (const CoarseWindow& window : evidence.windows) {
    double sum = 0.0, sum_m = 0.0;
    for (std::size_t c = window.begin; c < window.end; ++c) {
      const double w = evidence.weight_in(window, c);
      if (w == 0.0) continue;
      sum += w;
      sum_m += w * departure_m(c);
    }
    out += sum_m / sum * (sum_m / sum) / static_cast<double>(evidence.windows.size());
  }
  return out;
}

// `t_s` rise; `contact` has one mark a sample.
PathEvidence gather_evidence(const TipMotion& motion, std::span<const double> t_s, std::span<const char> contact,
                             const Eigen::Vector3d& tip_in_marker_m, const BasePathConfig& config);

}  // namespace asperity
