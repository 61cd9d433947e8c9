#include "asperity/fidelity/surface_stroke.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/smoothstep.h"
#include "asperity/base/units.h"
#include "asperity/geometry/mesh_point.h"

namespace asperity {

using Eigen::Vector3d;

namespace {

double length_m(const SurfaceLine& line) { return line.size() < 2 ? 0.0 : line.s_m.back(); }

// The line's point and normal at an arc length.
struct LinePlace {
  Vector3d p_world_m, n_world;
};
LinePlace place_at(const SurfaceLine& line, double s_m) {
  const auto after = std::upper_bound(line.s_m.begin(), line.s_m.end() - 1, s_m);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - line.s_m.begin(), 1)) - 1;
  const double u = std::clamp((s_m - line.s_m[i]) / (line.s_m[i + 1] - line.s_m[i]), 0.0, 1.0);
  return {lerp(line.p_world_m[i], line.p_world_m[i + 1], u),
          lerp(line.n_world[i], line.n_world[i + 1], u).normalized()};
}

// The way along a leg of `length_m` after `t_s`: the speed rises and falls evenly over `ramp_s` at either end.
double way_m(double length_m, double speed_mps, double ramp_s, double t_s) {
  const double leg_s = length_m / speed_mps + ramp_s;
  const auto risen = [&](double t) {
    return t < ramp_s ? 0.5 * speed_mps * t * t / ramp_s : speed_mps * (t - 0.5 * ramp_s);
  };
  return t_s < 0.5 * leg_s ? risen(t_s) : length_m - risen(std::max(leg_s - t_s, 0.0));
}

// The mean of the inward normals; the first's where they cancel.
Vector3d press_direction(const SurfaceLine& line) {
  Vector3d inward = Vector3d::Zero();
  for (const Vector3d& normal : line.n_world) inward -= normal;
  return inward.norm() > 0.0 ? inward.normalized() : Vector3d(-line.n_world.front());
}

}  // namespace

double steepest_rad(const SurfaceLine& line) {
  double least_cosine = 1.0;
  if (line.size() == 0) return 0.0;
  const Vector3d inward = press_direction(line);
  for (const Vector3d& normal : line.n_world) least_cosine = std::min(least_cosine, -inward.dot(normal));
  return std::acos(std::max(least_cosine, -1.0));
}

SurfaceLine shortened(const SurfaceLine& line, double margin_m) {
  const double length = length_m(line), margin = std::min(margin_m, 0.25 * length);
  if (!(margin > 0.0)) return line;
  SurfaceLine out;
  out.turns_away = line.turns_away;
  const auto add = [&](double s_m) {
    const LinePlace place = place_at(line, s_m);
    out.p_world_m.push_back(place.p_world_m);
    out.n_world.push_back(place.n_world);
    out.s_m.push_back(s_m - margin);
  };
  add(margin);
  for (const double s_m : line.s_m) {
    if (s_m > margin && s_m < length - margin) add(s_m);
  }
  add(length - margin);
  return out;
}

HandStroke stroke_along(const SurfaceLine& line, double duration_s, const SurfaceStrokeConfig& config) {
  const double length = length_m(line);
  if (!(length > 0.0)) throw Error("stroke: the line over the surface has no length");
  const double ramp_s = std::min(config.speed_ramp_s, length / config.speed_mps);
  const double leg_s = length / config.speed_mps + ramp_s;
  const double start_s = 2.0 * config.approach_s;
  const double whole_s = duration_s > 0.0 ? duration_s : start_s + 2.0 * leg_s;
  constexpr double kStep_s = 1e-3, kLongest_s = 36'000.0;
  if (!(whole_s <= kLongest_s)) throw Error("stroke: it would take longer than ten hours");
  const auto steps = static_cast<std::int64_t>(std::ceil(whole_s / kStep_s));
  HandStroke out;
  out.path.t_ns.reserve(static_cast<std::size_t>(steps) + 1);
  out.path.p_world_m.reserve(static_cast<std::size_t>(steps) + 1);
  out.press_N.reserve(static_cast<std::size_t>(steps) + 1);
  out.press_direction_world = press_direction(line);
  out.starts_ns = std::llround(start_s / kNanosecond_s);
  for (std::int64_t i = 0; i <= steps; ++i) {
    const double t_s = static_cast<double>(i) * kStep_s;
    const double stroke_s = std::max(t_s - start_s, 0.0);
    const double legs = std::floor(stroke_s / leg_s);
    const double way = way_m(length, config.speed_mps, ramp_s, stroke_s - legs * leg_s);
    const bool back = std::fmod(legs, 2.0) == 1.0;
    const LinePlace place = place_at(line, back ? length - way : way);
    const double above_m = (1.0 - smoothstep(t_s / config.approach_s)) * config.approach_m;
    out.path.t_ns.push_back(i * std::llround(kStep_s / kNanosecond_s));
    out.path.p_world_m.push_back(place.p_world_m + above_m * place.n_world);
    out.press_N.push_back(smoothstep(t_s / config.approach_s - 1.0) * config.press_N);
  }
  return out;
}

}  // namespace asperity
