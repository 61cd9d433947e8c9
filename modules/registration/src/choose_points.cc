#include "choose_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

#include "asperity/algebra/solve.h"

namespace asperity::registration {
namespace {

// So many times the points asked for are looked at.
constexpr std::size_t kCandidates = 10;

// Positions in `measure` (not falling, from 0) of `count` equal parts of it.
std::vector<std::uint32_t> equal_parts(const std::vector<double>& measure, std::size_t count) {
  std::vector<std::uint32_t> out;
  out.reserve(count);
  const double step = measure.back() / static_cast<double>(count);
  double next = 0.5 * step;
  for (std::uint32_t i = 0; i < measure.size() && out.size() < count; ++i) {
    if (measure[i] < next) continue;
    out.push_back(i);
    next = std::max(next + step, measure[i] + 0.5 * step);
  }
  return out;
}

// Half of the points by length, half by how much the normal turns along the path.
std::vector<std::uint32_t> by_curvature(const std::vector<Match>& matches, std::size_t count) {
  std::vector<double> turned(matches.size(), 0.0);
  for (std::size_t i = 1; i < matches.size(); ++i) turned[i] = turned[i - 1] + (matches[i].n - matches[i - 1].n).norm();
  if (!(turned.back() > 0.0)) return {};
  std::vector<double> measure(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    measure[i] = static_cast<double>(i) / static_cast<double>(matches.size()) + turned[i] / turned.back();
  }
  return equal_parts(measure, count);
}

// Cells of an octahedral map of directions, filled in turn.
std::vector<std::uint32_t> by_normal(const std::vector<Match>& matches, std::size_t count) {
  constexpr int kSide = 8;
  std::array<std::vector<std::uint32_t>, kSide * kSide> cells;
  for (std::uint32_t i = 0; i < matches.size(); ++i) {
    const Eigen::Vector3d n = matches[i].n / matches[i].n.cwiseAbs().sum();
    Eigen::Vector2d flat = n.head<2>();
    if (n.z() < 0.0) {
      flat = Eigen::Vector2d(std::copysign(1.0 - std::abs(n.y()), n.x()), std::copysign(1.0 - std::abs(n.x()), n.y()));
    }
    const auto cell = [](double u) { return std::clamp(static_cast<int>((0.5 + 0.5 * u) * kSide), 0, kSide - 1); };
    const int which = cell(flat.x()) * kSide + cell(flat.y());
    cells[static_cast<std::size_t>(which)].push_back(i);
  }
  // What a cell may give is raised until enough are given; each gives points evenly spread over its own.
  std::size_t quota = 0;
  for (std::size_t given = 0; given < std::min(count, matches.size()); ++quota) {
    given = 0;
    for (const auto& cell : cells) given += std::min(cell.size(), quota + 1);
  }
  std::vector<std::uint32_t> out;
  for (const auto& cell : cells) {
    const std::size_t take = std::min(cell.size(), quota);
    for (std::size_t k = 0; k < take; ++k) out.push_back(cell[k * cell.size() / take]);
  }
  return out;
}

// Each next point is the one that holds best the motion that is held worst so far.
std::vector<std::uint32_t> by_stability(const std::vector<Match>& matches, const PointSet& points,
                                        const CentredPose& pose, std::size_t count) {
  const Eigen::LLT<Matrix6> root(motion_metric(points, pose));
  std::vector<Vector6> rows(matches.size());
  Matrix6 sum = Matrix6::Zero();
  for (std::size_t i = 0; i < matches.size(); ++i) {
    rows[i] << (matches[i].y_m - pose.centre_m).cross(matches[i].n), matches[i].n;
    root.matrixL().solveInPlace(rows[i]);
    sum += rows[i] * rows[i].transpose();
  }
  const Matrix6 motions = symmetric_eigen(sum).vectors;
  std::array<std::vector<std::uint32_t>, 6> order;
  for (int k = 0; k < 6; ++k) {
    std::vector<double> hold(matches.size());
    for (std::size_t i = 0; i < matches.size(); ++i) hold[i] = std::abs(motions.col(k).dot(rows[i]));
    auto& list = order[static_cast<std::size_t>(k)];
    list.resize(matches.size());
    std::iota(list.begin(), list.end(), 0U);
    std::stable_sort(list.begin(), list.end(), [&](std::uint32_t a, std::uint32_t b) { return hold[a] > hold[b]; });
  }
  std::vector<char> taken(matches.size(), 0);
  std::array<std::size_t, 6> next{};
  Vector6 held = Vector6::Zero();
  std::vector<std::uint32_t> out;
  while (out.size() < std::min(count, matches.size())) {
    Eigen::Index weakest = 0;
    held.minCoeff(&weakest);
    const auto w = static_cast<std::size_t>(weakest);
    while (taken[order[w][next[w]]] != 0) ++next[w];
    const std::uint32_t i = order[w][next[w]];
    taken[i] = 1;
    out.push_back(i);
    held += (motions.transpose() * rows[i]).cwiseAbs2();
  }
  return out;
}

}  // namespace

std::vector<std::uint32_t> choose_uniform(const PointSet& points, std::size_t count) {
  if (count >= points.size() || !(points.s_m.back() > 0.0)) {
    std::vector<std::uint32_t> out(points.size());
    std::iota(out.begin(), out.end(), 0U);
    return out;
  }
  return equal_parts(points.s_m, count);
}

std::vector<std::uint32_t> choose_points(const RegistrationSurface& surface, const PointSet& points,
                                         const CentredPose& guess, PathSampling sampling, std::size_t count) {
  if (sampling == PathSampling::kUniform || count >= points.size()) return choose_uniform(points, count);
  const std::vector<std::uint32_t> candidates = choose_uniform(points, kCandidates * count);
  Matcher matcher(surface, points, candidates, {});
  matcher.match(guess);
  std::vector<std::uint32_t> out;
  switch (sampling) {
    case PathSampling::kUniform:
      break;
    case PathSampling::kCurvature:
      out = by_curvature(matcher.matches(), count);
      break;
    case PathSampling::kNormalSpace:
      out = by_normal(matcher.matches(), count);
      break;
    case PathSampling::kStability:
      out = by_stability(matcher.matches(), points, guess, count);
      break;
  }
  if (out.empty()) return choose_uniform(points, count);
  for (std::uint32_t& i : out) i = candidates[i];
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace asperity::registration
