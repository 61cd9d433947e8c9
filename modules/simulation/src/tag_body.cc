#include "asperity/simulation/tag_body.h"

#include <cmath>
#include <numbers>

namespace asperity {

std::vector<MarkerPlacement> front_tag_body(double size_m, double gap_m, int first_id) {
  const double half_m = 0.5 * (size_m + gap_m);
  const Eigen::Quaterniond upright = Eigen::Quaterniond::Identity();
  return {{first_id, "tag36h11", size_m, {upright, {0.0, -half_m, 0.0}}},
          {first_id + 1, "tag36h11", size_m, {upright, {0.0, half_m, 0.0}}}};
}

std::vector<MarkerPlacement> ring_tag_body(double size_m, int first_id) {
  constexpr int kFaces = 6;
  const double face_m = 1.25 * size_m;
  const double radius_m = 0.5 * face_m / std::tan(std::numbers::pi / kFaces);
  std::vector<MarkerPlacement> tags;
  for (int i = 0; i < kFaces; ++i) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(2.0 * std::numbers::pi * i / kFaces, Eigen::Vector3d::UnitY()));
    tags.push_back({first_id + i, "tag36h11", size_m, {turn, turn * Eigen::Vector3d(0.0, 0.0, -radius_m)}});
  }
  return tags;
}

}  // namespace asperity
