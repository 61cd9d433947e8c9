#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/registration/manual_alignment.h"

namespace asperity::app {

// Option values with units; throw UsageError naming the option and the text.
double length_option_m(const std::string& option, const std::string& text);
double speed_option_mps(const std::string& option, const std::string& text);
// A unit of length: its name (m, mm, …) or how long it is (0.06m). Positive, at most 1000 m.
double unit_option_m(const std::string& option, const std::string& text);
// Three lengths with commas between.
std::array<double, 3> lengths_option_m(const std::string& option, const std::string& text);

// A time such as 10s or 250ms, above 0 and at most `longest_s`.
double duration_option_s(const std::string& option, const std::string& text, double longest_s);
// A number within [low, high], with or without its unit behind it: "1.5" or "1.5N".
double number_option(const std::string& option, const std::string& text, const std::string& unit, double low,
                     double high);
// Whole numbers from 1 with commas between, such as 1,1,2.
std::vector<int> counts_option(const std::string& option, const std::string& text);
// A force such as 1.5N, from 0 to `most_N`.
double force_option_N(const std::string& option, const std::string& text, double most_N);
// x,y,z in metres, or each with a unit of length.
Eigen::Vector3d point_option_m(const std::string& option, const std::string& text);

// x,y,z,qw,qx,qy,qz: metres, and a quaternion, which is normalised.
Pose pose_option(const std::string& option, const std::string& text);

// Points "x,y,z;x,y,z;…" in units of `unit_m`.
std::vector<Eigen::Vector3d> points_option_m(const std::string& option, const std::string& text, double unit_m);

struct PickedPairs {
  std::vector<Eigen::Vector3d> p_world_m, p_mesh_m;
};
// Pairs of points "x,y,z=x,y,z;…": the first of each in metres, the second in units of `unit_m`.
PickedPairs pairs_option(const std::string& option, const std::string& text, double unit_m);

// x,y,z,rx,ry,rz: metres and degrees.
ManualAlignment alignment_option(const std::string& option, const std::string& text);

}  // namespace asperity::app
