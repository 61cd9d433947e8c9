#pragma once

#include "asperity/geometry/fit_circle.h"
#include "path_evidence.h"

namespace asperity {

// Of the probe from the surface's normal, as a hand holds it.
constexpr double kLargestLean_rad = 0.7853981633974483;  // 45°

Eigen::Vector3d mean_axis(const PathEvidence& evidence);  // of the probe, over the coarse points; zero if unknown

// A plane or circle candidate for the base shape.
struct PlaneCandidate {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // outward
  Eigen::Vector3d stroke = Eigen::Vector3d::UnitX();  // the path's main direction, in the plane
  double sigma_rad = 0.0;                             // of its rotation about the stroke, by path and probe
  double rms_m = 0.0;                                 // of the coarse points
  double tilt_rad = 0.0;                              // RMS angle between probe axis and normal
  double fine_m2 = 0.0;                               // mean square fine motion along the normal
};

struct CircleCandidate {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double radius_m = 0.0;
  double radius_stderr_m = 0.0;
  double significance = 0.0;  // curvature over its standard error
  bool outside = true;
  double rms_m = 0.0;
  double tilt_rad = 0.0;
  double fine_m2 = 0.0;
  bool covers_area = false;  // the path is a raster: it shows the normals itself
  // Of the normals' lean about the direction of travel: its mean over the path, and what changes along it.
  double lean_sigma_rad = 0.0;
  double lean_change_rad = 0.0;
};

PlaneCandidate fit_plane_candidate(const PathEvidence& evidence, const BasePathConfig& config);
// About the axis across the path's principal plane, which is a single stroke's. A raster on a cylinder lies in none: of
// the three principal axes, the likeliest against `plane`.
CircleCandidate fit_circle_candidate(const PlaneCandidate& plane, const PathEvidence& evidence,
                                     const BasePathConfig& config);

// The natural logarithm of the odds for the circle.
double circle_log_odds(const PlaneCandidate& plane, const CircleCandidate& circle, const PathEvidence& evidence,
                       const BasePathConfig& config);

}  // namespace asperity
