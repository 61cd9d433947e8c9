#include "closer_direction.h"

#include <algorithm>
#include <utility>

namespace asperity {

namespace {

constexpr double kBent = 0.996;          // cosine of 5°
constexpr double kReverses = 0.5;        // cosine of 60°
constexpr double kEnoughStraight = 0.3;  // of what is beside bends: the noise is that of the straight parts alone

struct Sum {
  double added_m = 0.0, slowness = 0.0;  // Σ 1/v
};

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

void mark_reversals(const EvenPath<2>& quick, const EvenPath<2>& sharp, const std::vector<char>& moving,
                    double rest_mps, std::size_t side, std::vector<PathPart>& parts) {
  for (std::size_t i = side; i + side < parts.size(); ++i) {
    if (moving[i - side] == 0 || moving[i + side] == 0) continue;
    const Eigen::Vector2d a = velocity_mps(quick, i - side), b = velocity_mps(quick, i + side);
    if (a.dot(b) < kReverses * a.norm() * b.norm() && velocity_mps(sharp, i).norm() > rest_mps)
      parts[i] = PathPart::kBend;
  }
}

CloserDirection::CloserDirection(const EvenPath<2>& sharp, const std::vector<Eigen::Vector2d>& tangent,
                                 const std::vector<char>& moving, std::vector<PathPart> parts, double rest_mps)
    : parts_(std::move(parts)) {
  if (std::find(parts_.begin(), parts_.end(), PathPart::kBend) == parts_.end()) return;
  turned_.assign(sharp.size(), Eigen::Vector2d::Zero());
  Sum straight, beside, bend;
  for (std::size_t i = 0; i < sharp.size(); ++i) {
    const Eigen::Vector2d v_mps = velocity_mps(sharp, i);
    const bool bent = parts_[i] == PathPart::kBend;
    // Nearly still cells would decide alone what noise adds: 1/v.
    if ((!bent && (moving[i] == 0 || v_mps.norm() < rest_mps)) || !(v_mps.norm() > 0.0)) continue;
    const Eigen::Vector2d turned = v_mps.normalized() - tangent[i];
    if (bent) turned_[i] = turned;
    Sum& sum = bent ? bend : parts_[i] == PathPart::kBesideBend ? beside : straight;
    sum.added_m += turned.dot(v_mps * sharp.step_s);
    sum.slowness += 1.0 / std::max(v_mps.norm(), rest_mps);
  }
  added_m_ = bend.added_m;
  if (straight.slowness < kEnoughStraight * beside.slowness) {
    straight.added_m += beside.added_m;
    straight.slowness += beside.slowness;
  }
  // Without a straight part no one knows what noise adds.
  if (!(bend.added_m > 0.0) || !(straight.slowness > 0.0)) return;
  const double by_noise_m = straight.added_m * bend.slowness / straight.slowness;
  share_ = std::clamp(1.0 - by_noise_m / bend.added_m, 0.0, 1.0);
}

}  // namespace asperity
