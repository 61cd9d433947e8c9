#include "asperity/simulation/scan_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "asperity/base/smoothstep.h"

namespace asperity {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPathSpacing_m = 0.05e-3;
constexpr double kLoop_m = 10e-3;  // length of the turn from a stroke back onto its own line
constexpr int kWaves = 3;
constexpr double kShortestWander_m = 0.04;  // a hand's slow deviation, longer than any relief
constexpr double kLongestWander_m = 0.25;

// The direction inside a turn of one half, and the turn's width per length: its curvature rises and
// falls as sin², so that the lateral acceleration has no steps.
double turn_angle(double share) { return kPi * (share - std::sin(2.0 * kPi * share) / (2.0 * kPi)); }

// A loop that ends where it begins: `turn_angle` and swings to either side, which leave its curvature 0 at both ends.
double loop_angle(double share, double swing_rad) {
  return turn_angle(share) - swing_rad * (std::sin(2.0 * kPi * share) - 0.5 * std::sin(4.0 * kPi * share));
}

double turn_width_per_length(double swing_rad = 0.0) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += std::sin(loop_angle((i + 0.5) / kSteps, swing_rad));
  return sum / kSteps;
}

// The swing at which the loop is closed across, by bisection; along it is so by its symmetry.
double closed_swing_rad() {
  double low = 0.0, high = 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (turn_width_per_length(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The angle of an arc of length `length_m` whose height over its chord is `sagitta_m`, by bisection of
// sagitta / length = (1 − cos(x/2)) / x, which rises up to a half circle.
double arc_angle(double length_m, double sagitta_m) {
  const double wanted = std::min(sagitta_m / length_m, 1.0 / kPi);
  double low = 0.0;
  double high = kPi;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (2.0 * std::pow(std::sin(0.25 * x), 2) / x < wanted ? low : high) = x;
  }
  return 0.5 * (low + high);
}

}  // namespace

ScanPath::ScanPath(const HandConfig& config, Random& random) {
  const bool to_and_fro = config.path == HandPathShape::kBackAndForth;
  const int strokes = to_and_fro ? config.strokes : 1;
  const bool is_loop = to_and_fro && config.row_spacing_m == 0.0;
  const double swing_rad = is_loop ? closed_swing_rad() : 0.0;
  const double turn_m = is_loop ? kLoop_m : to_and_fro ? config.row_spacing_m / turn_width_per_length() : 0.0;
  length_m_ = strokes * config.length_m + (strokes - 1) * turn_m;
  const double arc = config.path == HandPathShape::kCurved ? arc_angle(config.length_m, config.curve_sagitta_m) : 0.0;

  std::array<double, kWaves> per_m{}, slope{}, phase{};
  for (std::size_t k = 0; k < kWaves; ++k) {
    per_m[k] = 2.0 * kPi / std::exp(random.uniform(std::log(kShortestWander_m), std::log(kLongestWander_m)));
    slope[k] = config.lateral_wander_m * std::sqrt(2.0 / kWaves) * per_m[k];
    phase[k] = random.uniform(0.0, 2.0 * kPi);
  }
  const auto angle = [&](double s_m) {
    double sum = 0.0;
    for (std::size_t k = 0; k < kWaves; ++k) sum += slope[k] * std::cos(per_m[k] * s_m + phase[k]);
    if (config.path == HandPathShape::kCurved) return sum + arc * (0.5 - s_m / length_m_);
    if (!to_and_fro) return sum;
    const double period_m = config.length_m + turn_m;
    const int row = std::min(static_cast<int>(s_m / period_m), strokes - 1);
    const double in_row_m = s_m - row * period_m;
    double turned = row % 2 == 0 ? 0.0 : kPi;
    if (in_row_m > config.length_m && row + 1 < strokes) {
      const double share = loop_angle((in_row_m - config.length_m) / turn_m, swing_rad);
      turned += row % 2 == 0 ? share : -share;
    }
    return sum + turned;
  };

  const auto count = static_cast<std::size_t>(std::ceil(length_m_ / kPathSpacing_m)) + 1;
  nodes_.reserve(count);
  ScanPoint point;
  point.angle_rad = angle(0.0);
  nodes_.push_back(point);
  for (std::size_t i = 1; i < count; ++i) {
    const double s_m = kPathSpacing_m * static_cast<double>(i);
    const double middle = angle(std::min(s_m - 0.5 * kPathSpacing_m, length_m_));
    const double end = angle(std::min(s_m, length_m_));
    // Simpson's rule.
    point.a_m += kPathSpacing_m / 6.0 * (std::cos(point.angle_rad) + 4.0 * std::cos(middle) + std::cos(end));
    point.v_m += kPathSpacing_m / 6.0 * (std::sin(point.angle_rad) + 4.0 * std::sin(middle) + std::sin(end));
    point.angle_rad = end;
    nodes_.push_back(point);
  }

  // The middle of the stroke is the middle of the object; rows begin there. A straight stroke's wander is
  // about the row, not away from it.
  double a_sum = 0.0;
  double v_sum = 0.0;
  const auto first_row = static_cast<std::size_t>(config.length_m / kPathSpacing_m);
  const std::size_t used = std::min(first_row + 1, nodes_.size());
  for (std::size_t i = 0; i < used; ++i) {
    a_sum += nodes_[i].a_m;
    v_sum += nodes_[i].v_m;
  }
  for (ScanPoint& node : nodes_) {
    node.a_m -= a_sum / static_cast<double>(used);
    node.v_m -= v_sum / static_cast<double>(used);
  }
}

ScanPoint ScanPath::at(double s_m) const {
  const double last_m = kPathSpacing_m * static_cast<double>(nodes_.size() - 1);
  if (s_m <= 0.0 || s_m >= last_m) {
    const ScanPoint& end = s_m <= 0.0 ? nodes_.front() : nodes_.back();
    const double beyond_m = s_m <= 0.0 ? s_m : s_m - last_m;
    return {end.a_m + beyond_m * std::cos(end.angle_rad), end.v_m + beyond_m * std::sin(end.angle_rad), end.angle_rad};
  }
  const double place = s_m / kPathSpacing_m;
  const auto i = std::min(static_cast<std::size_t>(place), nodes_.size() - 2);
  const double u = place - static_cast<double>(i);
  const ScanPoint& from = nodes_[i];
  const ScanPoint& to = nodes_[i + 1];
  // Cubic Hermite with the directions as derivatives.
  const double w = 1.0 - u;
  const double h_to = smoothstep(u);
  const double d_from = u * w * w * kPathSpacing_m;
  const double d_to = -u * u * w * kPathSpacing_m;
  return {from.a_m + h_to * (to.a_m - from.a_m) + d_from * std::cos(from.angle_rad) + d_to * std::cos(to.angle_rad),
          from.v_m + h_to * (to.v_m - from.v_m) + d_from * std::sin(from.angle_rad) + d_to * std::sin(to.angle_rad),
          from.angle_rad + u * (to.angle_rad - from.angle_rad)};
}

}  // namespace asperity
