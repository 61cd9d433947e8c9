#include "refine_quad.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace asperity {

namespace {

using Eigen::Vector2d;

constexpr double kStep_px = 0.25;  // along the normal
constexpr double kLongestReach_px = 4.0;
constexpr int kRounds = 3;  // each looks about the edge that the one before has found

struct Line {
  Vector2d point, direction;
};

// Bilinear; nullopt outside.
std::optional<double> brightness(const GrayImage& image, const Vector2d& at_px) {
  const double x = std::floor(at_px.x()), y = std::floor(at_px.y());
  if (!(x >= 0.0 && y >= 0.0 && x + 1.0 < image.width && y + 1.0 < image.height)) return std::nullopt;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const double u = at_px.x() - x, v = at_px.y() - y;
  return (1.0 - v) * ((1.0 - u) * image.at(column, row) + u * image.at(column + 1, row)) +
         v * ((1.0 - u) * image.at(column, row + 1) + u * image.at(column + 1, row + 1));
}

struct EdgePoint {
  double offset_px = 0.0;  // along the normal
  double weight = 0.0;
};

std::optional<EdgePoint> find_edge(const GrayImage& image, const Vector2d& at_px, const Vector2d& outward,
                                   double reach_px) {
  EdgePoint out;
  std::optional<double> before;
  const int half = static_cast<int>(reach_px / kStep_px);
  for (int i = -half; i <= half; ++i) {
    const double s = i * kStep_px;
    const auto now = brightness(image, at_px + s * outward);
    if (!now) return std::nullopt;
    if (before && *now > *before) {
      const double weight = (*now - *before) * (*now - *before);
      out.offset_px += weight * (s - 0.5 * kStep_px);
      out.weight += weight;
    }
    before = now;
  }
  if (out.weight == 0.0) return std::nullopt;
  out.offset_px /= out.weight;
  return out;
}

std::optional<Line> fit_side(const GrayImage& image, const Vector2d& from, const Vector2d& to, double reach_px) {
  const double length_px = (to - from).norm();
  if (!(length_px > 2.0 * reach_px)) return std::nullopt;
  const Vector2d along = (to - from) / length_px;
  const Vector2d outward(along.y(), -along.x());
  // Near the corners the other side's edge is seen too.
  const double margin_px = std::max(reach_px, 0.08 * length_px);
  const int samples = std::max(4, static_cast<int>(length_px - 2.0 * margin_px));
  double weight = 0.0;
  Vector2d mean = Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  int missing = 0;
  for (int i = 0; i < samples; ++i) {
    const double t_px = margin_px + (length_px - 2.0 * margin_px) * (i + 0.5) / samples;
    const Vector2d base = from + t_px * along;
    const auto edge = find_edge(image, base, outward, reach_px);
    if (!edge) {
      ++missing;
      continue;
    }
    // About `from`, so that the moments keep their digits.
    const Vector2d point = t_px * along + edge->offset_px * outward;
    weight += edge->weight;
    mean += edge->weight * point;
    square += edge->weight * point * point.transpose();
  }
  if (2 * missing > samples || weight == 0.0) return std::nullopt;
  mean /= weight;
  const Eigen::Matrix2d spread = square / weight - mean * mean.transpose();
  const double angle = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  return Line{from + mean, {std::cos(angle), std::sin(angle)}};
}

std::optional<Vector2d> meet(const Line& a, const Line& b) {
  const double sine = a.direction.x() * b.direction.y() - a.direction.y() * b.direction.x();
  if (std::abs(sine) < 0.1) return std::nullopt;
  const Vector2d between = b.point - a.point;
  return a.point + (between.x() * b.direction.y() - between.y() * b.direction.x()) / sine * a.direction;
}

}  // namespace

bool refine_quad(const GrayImage& image, double cell_px, Eigen::Matrix<double, 2, 4>& corners_px) {
  const double reach_px = std::clamp(0.9 * cell_px, 1.0, kLongestReach_px);
  Eigen::Matrix<double, 2, 4> refined = corners_px;
  for (int round = 0; round < kRounds; ++round) {
    std::array<std::optional<Line>, 4> sides;
    for (int k = 0; k < 4; ++k) {
      sides[static_cast<std::size_t>(k)] = fit_side(image, refined.col(k), refined.col((k + 1) % 4), reach_px);
      if (!sides[static_cast<std::size_t>(k)]) return false;
    }
    for (int k = 0; k < 4; ++k) {
      const auto corner = meet(*sides[static_cast<std::size_t>((k + 3) % 4)], *sides[static_cast<std::size_t>(k)]);
      if (!corner || (*corner - corners_px.col(k)).norm() > std::max(cell_px, 1.0)) return false;
      refined.col(k) = *corner;
    }
  }
  corners_px = refined;
  return true;
}

}  // namespace asperity
