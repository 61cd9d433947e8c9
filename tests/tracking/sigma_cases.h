#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// The tracker's errors over its own standard errors, on drawn images of a camera and a body that are not quite what
// the tracker takes them for. What is wrong is drawn anew for every frame.
struct SigmaCase {
  std::string name;
  double focal = 0.0;        // standard deviation of the focal length's error, share; the centre's: that of fx
  double print_scale = 0.0;  // of the print's size, share
  double bend = 0.0;         // of the sag, share of the body's extent
  double placement_m = 0.0;  // of each tag's place
  double unknown_k1 = 0.0;   // of k1; the tracker is told of none
  double motion_m = 0.0;     // way of the body while the shutter is open
  bool stated = true;  // the tracker is told the sizes of the above, but of unknown_k1; else it takes its defaults
  bool board = false;  // a board of 20 tags instead of a body of two or three
};

std::vector<SigmaCase> sigma_cases();

struct SigmaRatios {
  int frames = 0, found = 0;
  Eigen::Matrix<double, 6, 1> rms = Eigen::Matrix<double, 6, 1>::Zero();  // of error over σ: x, y, z, about x, y, z
  double pooled = 0.0;                                                    // over all six
  double noise_pooled = 0.0;  // the same over the part that is of a frame alone
  double median_mm = 0.0, median_sigma_mm = 0.0;
};

// `frames` views at 0.25 to 0.6 m, half of them of tags in one plane, half of three on a sleeve.
SigmaRatios run_sigma_case(const SigmaCase& one, int frames, std::uint64_t seed);

}  // namespace asperity
