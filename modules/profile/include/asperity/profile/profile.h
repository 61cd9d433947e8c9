#pragma once

#include <limits>
#include <vector>

namespace asperity {

// Height along the scan path, uniform in arc length (profile.csv). Heights are nan in gaps.
struct Profile {
  double spacing_m = 0.025e-3;
  // The ends of the path in contact, between which the points lie; nan: not known.
  double from_m = std::numeric_limits<double>::quiet_NaN();
  double to_m = std::numeric_limits<double>::quiet_NaN();
  // Of it at either end, where the tip crept: the path is that long, but has no heights there (make_profile.h).
  double crept_first_m = 0.0, crept_last_m = 0.0;
  std::vector<double> s_m;              // along the base path (erratum 23)
  std::vector<double> height_m;         // along the outward normal, only the base shape removed
  std::vector<double> sigma_m;          // standard deviation of height_m; nan if the method gives none
  std::vector<double> texture_m;        // height_m after the high-pass
  std::vector<double> texture_sigma_m;  // standard deviation of texture_m (texture_noise.h); empty: not estimated
  std::vector<double> force_N;          // of the contact, along the normal (normal_force.h)
  std::vector<double> speed_mps;        // along the base path
  std::vector<double> t_s;  // when the tip passed, from the motion's first time; nan in gaps; empty: not known

  std::size_t size() const { return s_m.size(); }
};

}  // namespace asperity
