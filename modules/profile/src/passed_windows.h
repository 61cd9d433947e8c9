#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/profile/profile.h"

namespace asperity {

// The points of a profile in the order in which the tip passed them, in one of the windows over time.
struct PassedWindow {
  std::vector<double> s_m, t_s;
  std::vector<Eigen::Vector2d> unrolled_m;  // empty: not known
  std::vector<double> height_m;             // nan once in each gap: where points were left out, or the tip stood
  std::vector<double> weight;               // Hann, over the time
};

struct PassedWindows {
  std::vector<PassedWindow> windows;
  double length_s = 0.0;                                     // of each
  double spacing_m = 0.0;                                    // of points along the path
  double slow_mps = 0.0, typical_mps = 0.0, fast_mps = 0.0;  // 5th, 50th and 95th percentile of the speed
  double mean_square_m2 = 0.0;                               // of the heights
};

// The points with a height and a speed above a quarter of the median, in windows that overlap by half, of at most
// `longest_s`. Times are the profile's (Profile::t_s; where it is empty or falls, by the speeds). Windows of which less
// than half the time is of points are left out: their ordinates of noise are larger, and would count for more.
PassedWindows find_passed_windows(const Profile& profile, std::span<const double> height_m,
                                  std::span<const Eigen::Vector2d> unrolled_m, double longest_s);

}  // namespace asperity
