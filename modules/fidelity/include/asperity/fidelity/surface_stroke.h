#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/fidelity/device_path.h"
#include "asperity/scene/scene.h"

namespace asperity {

// A line over the surface of a scene for a tip to follow, in the scene's world.
struct SurfaceLine {
  std::vector<Eigen::Vector3d> p_world_m;
  std::vector<Eigen::Vector3d> n_world;  // unit, outward, interpolated between the mesh's corner normals
  std::vector<double> s_m;               // along it, from 0, rising
  bool turns_away = false;               // it ends where the surface turns away

  std::size_t size() const { return s_m.size(); }
};

// One direction of pressing serves no surface that turns away from it: textured_line and line_across end where the
// normal is more than 60 degrees from that of their middle.

// The longest line without a jump along the x of the first texture of the scene: what was scanned or painted. It runs
// at y = 0, or in the middle of coordinates that lie on one side of it, and beside that by a thousandth of their width:
// a path along edges of the mesh has their corners on either side of 0 by rounding. Empty if no triangle has a texture.
SurfaceLine textured_line(const Scene& scene);

// The shortest path over the first object between the points of it nearest to two others. Throws Error as
// virtual_path (paint.h) does, and for a scene without objects. It may lead round edges.
SurfaceLine line_between(const Scene& scene, const Eigen::Vector3d& from_world_m, const Eigen::Vector3d& to_world_m);

// Straight on over the first object, along its longest axis, through the point where its shortest axis leaves it:
// for `length_m`, half to either side, or as far as the surface goes. Axes are those of the box in its own frame.
// Throws Error for a scene without objects.
SurfaceLine line_across(const Scene& scene, double length_m);

// The largest angle between its normals and the direction in which stroke_along presses, inwards.
double steepest_rad(const SurfaceLine& line);

// The line without `margin_m` at either end, but never less than its middle half: a hand keeps away from borders.
SurfaceLine shortened(const SurfaceLine& line, double margin_m);

struct SurfaceStrokeConfig {
  double speed_mps = 0.05;
  double press_N = 1.0;
  double approach_m = 2e-3;
  double approach_s = 0.2;
  double speed_ramp_s = 0.1;
  double margin_m = 2e-3;

  template <class V>
  void visit(V& v) {
    v.field("speed_mps", speed_mps, "of the stroke over the surface, m/s", {1e-4, 10.0});
    v.field("press_N", press_N, "force that presses it in, N", {0.0, 50.0});
    v.field("approach_m", approach_m, "above the surface, where the stroke begins, m", {0.0, 1.0});
    v.field("approach_s", approach_s, "time of coming down, and of pressing after that, s", {1e-2, 100.0});
    v.field("speed_ramp_s", speed_ramp_s, "time in which the speed is reached, and lost, s", {1e-3, 100.0});
    v.former("turn_s");
    v.field("margin_m", margin_m, "left out at the ends of a line that nobody chose, m", {0.0, 1.0});
  }
};

// What a hand intends that strokes a line: where to be, and how hard to press there.
struct HandStroke {
  DevicePath path;
  std::vector<double> press_N;                                       // one a point
  Eigen::Vector3d press_direction_world = Eigen::Vector3d::UnitZ();  // unit, mean of the line's inward normals
  std::int64_t starts_ns = 0;                                        // down and pressing: the stroke begins
};

// A hand that comes down at the line's start, presses, and moves back and forth along it at even speed for `duration_s`
// in all; to the end and back once if that is 0. Points are a millisecond apart. Throws Error for a line without length
// and for more than ten hours.
HandStroke stroke_along(const SurfaceLine& line, double duration_s, const SurfaceStrokeConfig& config);

}  // namespace asperity
