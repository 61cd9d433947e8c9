#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/geometry/triangle_mesh.h"

namespace bench {

// The motions that map a body onto itself: those listed, each after any rotation about `axis` where it has one (through
// the origin), or after any rotation at all about the origin.
struct Symmetry {
  std::vector<asperity::Pose> motions{asperity::Pose{}};
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  bool sphere = false;

  bool any() const { return motions.size() > 1 || !axis.isZero() || sphere; }
};

// How far a pose is from the truth: RMS displacement of the points, and the angle.
struct PoseDifference {
  double rms_m = 0.0;
  double rotation_rad = 0.0;
};

// Of the motions that map the body onto itself the one that leaves the least, with `limit_m` and `limit_rad` as the
// measures of the two.
PoseDifference difference_modulo(const Symmetry& symmetry, const asperity::Pose& found, const asperity::Pose& truth,
                                 const std::vector<Eigen::Vector3d>& p_world_m, double limit_m, double limit_rad);

struct Body {
  std::string name;
  asperity::TriangleMesh mesh;  // m, about its own axes
  Symmetry symmetry;
};

Body make_sphere(double radius_m);
Body make_ellipsoid(const Eigen::Vector3d& semi_axes_m);
Body make_box(const Eigen::Vector3d& sides_m);
Body make_prism(int sides, double radius_m, double height_m);
Body make_cylinder(double radius_m, double height_m);
Body make_bumpy_pebble(std::uint64_t seed);

// Its image in the plane x = 0, which no motion makes of a body without symmetry.
Body mirrored(const Body& body);

// A mesh of a file, its longest side `longest_m`.
Body read_body(const std::string& file, double longest_m);

}  // namespace bench
