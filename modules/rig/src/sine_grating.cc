#include "asperity/rig/sine_grating.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr double kFullCircle_rad = 2.0 * std::numbers::pi;

void refuse_shape(const SineGratingConfig& sine, const SineGratingShape& shape) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!positive(sine.pitch_m) || !positive(sine.depth_m) || !positive(shape.width_m) || !positive(shape.ramp_m) ||
      !positive(shape.rim_m) || !positive(shape.land_m) || !positive(shape.height_m)) {
    throw Error("sine grating: every length must be positive");
  }
  if (shape.periods < 1 || shape.steps < 4 || static_cast<double>(shape.periods) * shape.steps > 1e5) {
    throw Error(fmt::format("sine grating: {} periods of {} corners: from 1 period of 4 to 100000 corners in all",
                            shape.periods, shape.steps));
  }
  if (!(0.5 * sine.depth_m < shape.height_m)) {
    throw Error(fmt::format("sine grating: a depth of {:g} mm cuts through a plate of {:g} mm", 1e3 * sine.depth_m,
                            1e3 * shape.height_m));
  }
}

// Rows of four corners across (rim, relief, relief, rim; the rims are level) over x, and the walls and bottom under
// them.
class GratingBuilder {
 public:
  GratingBuilder(const SineGratingConfig& sine, const SineGratingShape& shape) {
    const int steps = shape.periods * shape.steps;
    const double length_m = shape.periods * sine.pitch_m;
    const double outer_m = shape.width_m + 2.0 * (shape.ramp_m + shape.rim_m);
    y_m_ = {0.0,
            shape.rim_m,
            shape.rim_m + shape.ramp_m,
            shape.rim_m + shape.ramp_m + shape.width_m,
            outer_m - shape.rim_m,
            outer_m};
    add_row(0.0, shape.height_m, shape.height_m);
    for (int i = 0; i <= steps; ++i) {
      // Exactly level where the phase is whole: sin(2πn) is not 0 in doubles.
      const double z_m =
          i % shape.steps == 0 ? 0.0 : 0.5 * sine.depth_m * std::sin(kFullCircle_rad * (i % shape.steps) / shape.steps);
      add_row(shape.land_m + length_m * i / steps, shape.height_m + z_m, shape.height_m);
    }
    add_row(2.0 * shape.land_m + length_m, shape.height_m, shape.height_m);
    const double end_m = 2.0 * shape.land_m + length_m;
    floor_ = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const double x_m : {0.0, end_m}) {
      for (const double y_m : y_m_) mesh.vertices_m.emplace_back(x_m, y_m, 0.0);
    }
    top();
    long_walls();
    ends_and_floor();
  }

  TriangleMesh mesh;

 private:
  static constexpr std::uint32_t kColumns = 6;

  void add_row(double x_m, double relief_m, double level_m) {
    const std::array<double, kColumns> z_m{level_m, level_m, relief_m, relief_m, level_m, level_m};
    for (std::size_t j = 0; j < kColumns; ++j) mesh.vertices_m.emplace_back(x_m, y_m_[j], z_m[j]);
    ++rows_;
  }
  std::uint32_t corner(std::uint32_t row, std::uint32_t column) const { return row * kColumns + column; }
  std::uint32_t below(std::uint32_t end, std::uint32_t column) const { return floor_ + end * kColumns + column; }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }

  void top() {
    for (std::uint32_t row = 0; row + 1 < rows_; ++row) {
      for (std::uint32_t j = 0; j + 1 < kColumns; ++j) {
        quad(corner(row, j), corner(row + 1, j), corner(row + 1, j + 1), corner(row, j + 1));
      }
    }
  }

  // The rim's upper edge is straight: a fan from one lower corner, and a triangle to the other.
  void long_walls() {
    for (std::uint32_t row = 0; row + 1 < rows_; ++row) {
      mesh.triangles.push_back({below(0, 0), corner(row + 1, 0), corner(row, 0)});
      mesh.triangles.push_back({below(0, kColumns - 1), corner(row, kColumns - 1), corner(row + 1, kColumns - 1)});
    }
    mesh.triangles.push_back({below(0, 0), below(1, 0), corner(rows_ - 1, 0)});
    mesh.triangles.push_back({below(0, kColumns - 1), corner(rows_ - 1, kColumns - 1), below(1, kColumns - 1)});
  }

  void ends_and_floor() {
    for (std::uint32_t j = 0; j + 1 < kColumns; ++j) {
      quad(below(0, j), corner(0, j), corner(0, j + 1), below(0, j + 1));
      quad(below(1, j), below(1, j + 1), corner(rows_ - 1, j + 1), corner(rows_ - 1, j));
      quad(below(0, j), below(0, j + 1), below(1, j + 1), below(1, j));
    }
  }

  std::array<double, kColumns> y_m_{};
  std::uint32_t rows_ = 0;
  std::uint32_t floor_ = 0;
};

}  // namespace

TriangleMesh make_sine_grating(const SineGratingConfig& sine, const SineGratingShape& shape) {
  refuse_shape(sine, shape);
  return GratingBuilder(sine, shape).mesh;
}

TracedSine::TracedSine(const SineGratingConfig& sine, double tip_radius_m)
    : amplitude_m_(0.5 * sine.depth_m),
      slope_(0.5 * sine.depth_m * kFullCircle_rad / sine.pitch_m),
      reach_rad_(kFullCircle_rad / sine.pitch_m * tip_radius_m) {
  const double reached_m = sine.pitch_m * sine.pitch_m / (2.0 * std::numbers::pi * std::numbers::pi * sine.depth_m);
  if (!(tip_radius_m >= 0.0 && tip_radius_m < reached_m)) {
    throw Error(
        fmt::format("a tip of {:.3g} mm radius does not reach into the valleys of a sine of {:.3g} mm pitch and "
                    "{:.3g} mm depth, which are {:.3g} mm in radius",
                    1e3 * tip_radius_m, 1e3 * sine.pitch_m, 1e3 * sine.depth_m, 1e3 * reached_m));
  }
}

// The ball touches at phase u, and its centre is at u − k r z'/√(1+z'²): solved for u by bisection between the widest
// that can be, which the curvature's bound makes monotone.
double TracedSine::height_m(double phase_rad) const {
  const auto tilt = [&](double u) { return slope_ * std::cos(u); };
  double low = phase_rad - reach_rad_;
  double high = phase_rad + reach_rad_;
  constexpr int kHalvings = 50;
  for (int i = 0; i < kHalvings; ++i) {
    const double u = 0.5 * (low + high);
    const double centre = u - reach_rad_ * tilt(u) / std::hypot(1.0, tilt(u));
    (centre < phase_rad ? low : high) = u;
  }
  const double u = 0.5 * (low + high);
  const double radius_m = slope_ > 0.0 ? reach_rad_ * amplitude_m_ / slope_ : 0.0;
  return amplitude_m_ * std::sin(u) + radius_m * (1.0 / std::hypot(1.0, tilt(u)) - 1.0);
}

double TracedSine::fundamental_share() const {
  constexpr int kSteps = 256;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double phase_rad = kFullCircle_rad * i / kSteps;
    sum += height_m(phase_rad) * std::sin(phase_rad);
  }
  return 2.0 * sum / kSteps / amplitude_m_;
}

}  // namespace asperity
