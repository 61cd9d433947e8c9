#pragma once

#include <string>

#include "asperity/profile/profile.h"

namespace asperity::examples {

// The part of a profile that is drawn.
struct ProfilePlot {
  std::string title;
  double from_m = 0.0;
  double to_m = 0.02;
  double shift_m = 0.0;  // added to the measured arc length, as compare_profiles finds it
};

// An SVG drawing, 900 by 300 px: the measured height with its band of two standard deviations over the true
// height, in µm over mm. The two have no common zero along the normal, so each is drawn about its own mean
// over the part drawn. Throws Error if that part holds fewer than two heights of either.
std::string profile_svg(const Profile& measured, const Profile& truth, const ProfilePlot& plot);

}  // namespace asperity::examples
