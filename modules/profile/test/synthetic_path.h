#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/geometry/motion.h"
#include "asperity/geometry/pose.h"

namespace asperity::synthetic {

// A motion with everything known: the tip on a base shape plus a height along its normal.
struct Scan {
  TipMotion motion;
  Eigen::Vector3d tip_in_marker_m{0.0, 0.0, -0.12};
  std::vector<double> s_m, height_m;
  std::vector<Eigen::Vector3d> normal;
};

// Low-frequency noise: white noise through two equal poles, with the given standard deviation.
class SlowNoise {
 public:
  SlowNoise(double sigma, double corner_hz, double rate_hz, std::uint64_t seed)
      : random_(seed), sigma_(sigma), a_(std::exp(-2.0 * std::numbers::pi * corner_hz / rate_hz)) {
    for (int i = 0; i < static_cast<int>(4.0 * rate_hz / corner_hz); ++i) next();
  }
  double next() {
    first_ = a_ * first_ + (1.0 - a_) * random_.normal();
    second_ = a_ * second_ + (1.0 - a_) * first_;
    const double variance = (1.0 - a_) / (1.0 + a_) * (1.0 + a_ * a_) / ((1.0 + a_) * (1.0 + a_));
    return sigma_ * second_ / std::sqrt(variance);
  }

 private:
  Random random_;
  double sigma_, a_, first_ = 0.0, second_ = 0.0;
};

struct Point {
  Eigen::Vector3d p_m;
  Eigen::Vector3d normal;
  double s_m;
};

struct Options {
  double rate_hz = 4000.0;
  double duration_s = 5.0;
  double slow_sigma_m = 0.0;
  double slow_corner_hz = 0.5;
  double fine_sigma_m = 0.0;
  std::uint64_t seed = 1;
  Eigen::Vector3d probe_lean = Eigen::Vector3d::Zero();  // added to the normal for the probe's axis
};

// `base` gives the base point at time t, `height` the height at arc length s.
inline Scan make_scan(const std::function<Point(double)>& base, const std::function<double(double)>& height,
                      const Options& o) {
  Scan out;
  Random random(o.seed, 7);
  SlowNoise nx(o.slow_sigma_m, o.slow_corner_hz, o.rate_hz, 3 * o.seed),
      ny(o.slow_sigma_m, o.slow_corner_hz, o.rate_hz, 3 * o.seed + 1),
      nz(o.slow_sigma_m, o.slow_corner_hz, o.rate_hz, 3 * o.seed + 2);
  const auto n = static_cast<std::size_t>(o.duration_s * o.rate_hz) + 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / o.rate_hz;
    const Point b = base(t);
    const double h = height(b.s_m);
    const Eigen::Vector3d slow(nx.next(), ny.next(), nz.next());
    const Eigen::Vector3d fine = o.fine_sigma_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    out.motion.t_ns.push_back(static_cast<std::int64_t>(std::llround(t * 1e9)));
    out.motion.p_world_tip_m.emplace_back(b.p_m + h * b.normal + slow + fine);
    out.motion.q_world_marker.push_back(shortest_rotation(Eigen::Vector3d::UnitZ(), b.normal + o.probe_lean));
    out.motion.force_N.push_back(1.0);
    out.s_m.push_back(b.s_m);
    out.height_m.push_back(h);
    out.normal.push_back(b.normal);
  }
  return out;
}

// Turns a plane curve x(t), y(t) with its arc length by sums over a thousandth of the sampling steps'
// size, independent of what is tested, into base points on a tilted plane.
inline std::function<Point(double)> on_plane(const std::function<Eigen::Vector2d(double)>& curve,
                                             const std::function<double(double)>& s) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.6, Eigen::Vector3d(1.0, 0.4, -0.3).normalized()));
  return [=](double t) {
    const Eigen::Vector2d u = curve(t);
    return Point{turn * Eigen::Vector3d(u.x(), u.y(), 0.0) + Eigen::Vector3d(0.1, -0.2, 0.4),
                 turn * Eigen::Vector3d::UnitZ(), s(t)};
  };
}

// An arc of the given radius on the plane, at constant speed.
inline std::function<Point(double)> arc_on_plane(double radius_m, double speed_mps) {
  return on_plane(
      [=](double t) {
        const double a = speed_mps * t / radius_m;
        return Eigen::Vector2d(radius_m * std::sin(a), radius_m * (1.0 - std::cos(a)));
      },
      [=](double t) { return speed_mps * t; });
}

// Across a cylinder of the given radius; inside or outside.
inline std::function<Point(double)> across_cylinder(double radius_m, double speed_mps, bool outside) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(-0.8, Eigen::Vector3d(0.2, 1.0, 0.5).normalized()));
  return [=](double t) {
    const double a = speed_mps * t / radius_m - 0.6;
    const Eigen::Vector3d radial = turn * Eigen::Vector3d(std::cos(a), std::sin(a), 0.0);
    return Point{radius_m * radial + Eigen::Vector3d(0.0, 0.1, 0.5), outside ? radial : Eigen::Vector3d(-radial),
                 speed_mps * t};
  };
}

inline std::function<double(double)> sine(double amplitude_m, double pitch_m) {
  return [=](double s) { return amplitude_m * std::sin(2.0 * std::numbers::pi * s / pitch_m); };
}

}  // namespace asperity::synthetic
