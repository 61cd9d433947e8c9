#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/base/problem.h"
#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"
#include "asperity/profile/find_contact.h"
#include "asperity/profile/measure_arc_length.h"
#include "asperity/profile/normal_force.h"

namespace asperity {

enum class PathShape {
  kAuto,          // plane, circle, doubly curved or curve, by the evidence
  kPlane,         // a flat object; a path too straight to fix the plane takes the probe's axis to help
  kCircle,        // a body of revolution scanned across its axis: normals lie in the path's plane
  kLine,          // a straight stroke: the normal from the probe's axis and the texture's direction alone
  kCurve,         // none of these: the path's own long waves
  kMesh,          // a registered mesh (base_path_on_mesh.h)
  kDoublyCurved,  // a surface of two curvatures, by a path that covers an area: rows over a sphere
};
inline constexpr std::array<std::string_view, 7> kPathShapeNames{"auto",  "plane", "circle",       "line",
                                                                 "curve", "mesh",  "doubly_curved"};

struct BasePathConfig {
  PathShape shape = PathShape::kAuto;
  double slow_error_m = 0.1e-3;
  double probe_axis_sigma_deg = 20.0;
  double texture_axis_sigma_deg = 10.0;
  double undetermined_deg = 5.0;
  double curve_cutoff_cycles_per_mm = 0.02;
  double shape_tolerance_m = 1e-3;
  double max_height_m = 3e-3;
  ContactConfig contact;
  ArcLengthConfig arc_length;

  template <class V>
  void visit(V& v) {
    v.choice("shape", shape, kPathShapeNames, "base shape under the texture");
    v.field("slow_error_m", slow_error_m, "standard deviation of the position's error below 2 Hz", {1e-9, 1.0});
    v.field("probe_axis_sigma_deg", probe_axis_sigma_deg, "how far the probe is held from the normal", {0.1, 90.0});
    v.field("texture_axis_sigma_deg", texture_axis_sigma_deg,
            "how far the fine motion may lie from the normal; 0: not used", {0.0, 90.0});
    v.field("undetermined_deg", undetermined_deg, "a normal less certain than this is reported", {0.0, 90.0});
    v.field("curve_cutoff_cycles_per_mm", curve_cutoff_cycles_per_mm, "low-pass of the path that makes the base curve",
            {1e-4, 1.0});
    v.field("shape_tolerance_m", shape_tolerance_m, "RMS departure from plane and circle that makes a curve",
            {0.0, 1.0});
    v.field("max_height_m", max_height_m, "without a force sensor: further from the base is out of contact",
            {0.0, 1.0});
    v.group("contact", contact);
    v.group("arc_length", arc_length);
  }
};

// A rotation that the data leave open.
struct UndeterminedRotation {
  std::string description;
  double sigma_deg = 0.0;
};

struct BasePathResult {
  BasePath path;
  PathShape shape = PathShape::kPlane;
  double shape_probability = 1.0;  // of the shape chosen against its rival; 1 if it was given
  std::vector<char> contact;       // one a sample
  std::vector<double> speed_mps;   // along the path, one a sample
  std::vector<std::size_t> turning_points;
  double bends_m = 0.0;  // what a direction that follows bends closer adds to them (measure_arc_length.h)
  std::vector<UndeterminedRotation> undetermined;

  Eigen::Vector3d centre_world_m = Eigen::Vector3d::Zero();  // a point of the plane, the vertex, or the circle's centre
  Eigen::Vector3d axis_world = Eigen::Vector3d::UnitZ();     // the outward normal (there), or the circle's axis
  double radius_m = 0.0;                                     // circle
  // Doubly curved: the principal curvatures at the vertex, the larger first; positive bulges towards the probe.
  Eigen::Vector2d curvatures_per_m = Eigen::Vector2d::Zero();
  double radius_stderr_m = 0.0;  // allowing for errors that last
  bool outside = true;           // circle: the probe is on its outside
  // Circle and curve: the mean by which n_world is turned from the shape's own normals, the circle's towards its axis,
  // about its centre; the change of the lean along the path comes to it (docs/profile.md).
  double lean_rad = 0.0;
  double normal_sigma_deg = 0.0;  // of the normal about the direction of travel
  double probe_tilt_deg = 0.0;    // mean angle between the probe's axis and the normal
  double base_rms_m = 0.0;        // of the path's 10 mm means from the base shape
  double length_m = 0.0;
  // Of a base on which lengths are those of the unloaded surface, not of the tip's path below it: how deep the tip went
  // on average, its standard deviation, and the arc length along its path (empty: path.s_m is that).
  double indentation_m = 0.0;
  double indentation_sigma_m = 0.0;
  std::vector<double> tip_s_m;
  NormalForce force;  // along n_world, without the values, which the motion has; nothing if it was not asked for
  Problems problems;
};

// The base path under `motion`, its outward normals and its arc length (seed §1.4, §4.3, §6.2; errata 23
// and 24). The base shape is fitted to the path in contact, weighted by the distance travelled, so that
// rests and the approach do not count. Outward is where the probe is: (p_marker - p_tip)·n > 0 with
// p_marker = p_tip - R tip_in_marker_m.
//
// How far the plane turns about the stroke is found from the path's lateral extent against `slow_error_m` (no smaller
// than the motion's own standard deviation) and from the probe's axis; how far a circle's normals lean, from the same
// and from the sideways curvature of a hand's stroke. Both are then corrected by the motion above 4 Hz, in which tremor
// across the path and texture along the normal are not correlated, and by a force with three axes
// (docs/profile-lean.md). A path in rows may also lie on a doubly curved surface
// (docs/profile-base.md). Between plane and circle decide the curvature's significance, the probe's axis, the fine
// motion's direction and the residuals.
// Throws Error for fewer than 20 samples, sizes that differ, or numbers that are not finite.
BasePathResult find_base_path(const TipMotion& motion, const Eigen::Vector3d& tip_in_marker_m,
                              const BasePathConfig& config);

}  // namespace asperity
