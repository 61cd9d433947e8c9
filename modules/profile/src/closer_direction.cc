#include "closer_direction.h"

#include <algorithm>
#include <utility>

namespace asperity {

namespace {

constexpr double kBent = 0.996;  // cosine of 5°

}  // namespace

std::vector<PathPart> find_bends(const EvenPath<2>& slow, const EvenPath<2>& quick, const std::vector<char>& moving,
                                 const std::vector<char>& cut, std::size_t reach) {
  const std::size_t n = moving.size();
  std::vector<PathPart> out(n, PathPart::kStraight);
  std::size_t marked = 0;  // up to which
  for (std::size_t i = 0; i < n; ++i) {
    if (cut[i] == 0) continue;
    for (std::size_t j = std::max(marked, i - std::min(i, reach)); j < std::min(n, i + reach + 1); ++j) {
      const Eigen::Vector2d a = velocity_mps(slow, j), b = velocity_mps(quick, j);
      out[j] = moving[j] != 0 && a.dot(b) < kBent * a.norm() * b.norm() ? PathPart::kBend : PathPart::kBesideBend;
    }
    marked = std::min(n, i + reach + 1);
  }
  return out;
}

CloserDirection::CloserDirection(const EvenPath<2>& sharp, const std::vector<Eigen::Vector2d>& tangent,
                                 const std::vector<char>& moving, std::vector<PathPart> parts)
    : parts_(std::move(parts)) {
  if (std::find(parts_.begin(), parts_.end(), PathPart::kBend) == parts_.end()) return;
  turned_.assign(sharp.size(), Eigen::Vector2d::Zero());
  double straight_added_m = 0.0, straight_slowness = 0.0, bend_added_m = 0.0, bend_slowness = 0.0;  // Σ 1/v
  for (std::size_t i = 0; i < sharp.size(); ++i) {
    const Eigen::Vector2d v_mps = velocity_mps(sharp, i);
    if (moving[i] == 0 || parts_[i] == PathPart::kBesideBend || !(v_mps.norm() > 0.0)) continue;
    turned_[i] = v_mps.normalized() - tangent[i];
    const Eigen::Vector2d step_m = v_mps * sharp.step_s;
    const bool bent = parts_[i] == PathPart::kBend;
    (bent ? bend_added_m : straight_added_m) += turned_[i].dot(step_m);
    (bent ? bend_slowness : straight_slowness) += 1.0 / v_mps.norm();
  }
  added_m_ = bend_added_m;
  // Without a straight part no one knows what noise adds.
  if (!(bend_added_m > 0.0) || !(straight_slowness > 0.0)) return;
  const double by_noise_m = straight_added_m * bend_slowness / straight_slowness;
  share_ = std::clamp(1.0 - by_noise_m / bend_added_m, 0.0, 1.0);
}

}  // namespace asperity
