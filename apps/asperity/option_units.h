#pragma once

#include <array>
#include <string>

#include "asperity/geometry/pose.h"

namespace asperity::app {

// Option values with units; throw UsageError naming the option and the text.
double length_option_m(const std::string& option, const std::string& text);
double speed_option_mps(const std::string& option, const std::string& text);
// A unit of length: its name (m, mm, …) or how long it is (0.06m). Positive, at most 1000 m.
double unit_option_m(const std::string& option, const std::string& text);
// Three lengths with commas between.
std::array<double, 3> lengths_option_m(const std::string& option, const std::string& text);

// x,y,z,qw,qx,qy,qz: metres, and a quaternion, which is normalised.
Pose pose_option(const std::string& option, const std::string& text);

}  // namespace asperity::app
