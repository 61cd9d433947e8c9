#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "path_evidence.h"

namespace asperity {

// A smooth curve, evenly spaced along the path that it was made from, with outward normals.
struct BaseCurve {
  double spacing_m = 0.0;
  std::vector<Eigen::Vector3d> p_m;
  std::vector<Eigen::Vector3d> tangent;  // unit
  std::vector<Eigen::Vector3d> normal;   // unit, across the tangent, towards the probe
  std::vector<double> s_m;               // its own arc length
};

// The path's waves longer than 1/cutoff, and the probe's axis across it, smoothed alike.
BaseCurve make_base_curve(const PathEvidence& evidence, double cutoff_cycles_per_mm);

// For each sample the curve's point nearest to it, begun at the place that the even path gives.
struct CurvePoint {
  Eigen::Vector3d p_m;
  Eigen::Vector3d normal;
  double s_m;
};
std::vector<CurvePoint> project_on_curve(const BaseCurve& curve, const PathEvidence& evidence,
                                         std::span<const double> t_s, std::span<const Eigen::Vector3d> p_m);

}  // namespace asperity
