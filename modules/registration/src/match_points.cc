#include "match_points.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace asperity::registration {
namespace {

// Relative to the points' radius: the direction of a shorter offset is rounding.
constexpr double kMatchRounding = 1e-10;
// An offset from the closest point that leans farther than this (as a cosine) from the normal means that the closest
// point lies on an edge: the distance then grows along the offset.
constexpr double kEdgeCos = 0.95;

// Whether the closest point lies on an edge that borders the mesh.
bool on_border(const RegistrationFacet& facet, const Eigen::Vector3d& barycentric) {
  if (facet.border == 0) return false;
  for (int e = 0; e < 3; ++e) {
    // Edge e lies opposite corner e + 2.
    if ((facet.border >> e & 1U) != 0 && barycentric((e + 2) % 3) <= 0.0) return true;
  }
  return false;
}

}  // namespace

Matcher::Matcher(const RegistrationSurface& surface, const PointSet& points, std::span<const std::uint32_t> chosen,
                 const MatchRules& rules)
    : surface_(&surface),
      rules_(rules),
      chosen_(chosen.begin(), chosen.end()),
      closest_(chosen.size()),
      matches_(chosen.size()) {
  rounding_m_ = kMatchRounding * (points.radius_m + points.mean_world_m.norm());
  x_m_.reserve(chosen.size());
  outward_.reserve(chosen.size());
  scratch_.reserve(chosen.size());
  for (const std::uint32_t i : chosen) {
    x_m_.push_back(points.x_m[i]);
    outward_.push_back(points.outward[i]);
  }
}

void Matcher::match(const CentredPose& pose, double shrink) {
  const Eigen::Matrix3d r = pose.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < x_m_.size(); ++i) {
    Match& m = matches_[i];
    m.y_m = r * (shrink * x_m_[i]) + pose.centre_m;
    // Paths are walked in order: the neighbour's answer is the first guess.
    const ClosestPoint& before = closest_[i].found() ? closest_[i] : closest_[i == 0 ? 0 : i - 1];
    closest_[i] = before.found() ? surface_->bvh->closest_point(m.y_m, before) : surface_->bvh->closest_point(m.y_m);
    pair(i, r * outward_[i]);
  }
}

void Matcher::pair(std::size_t i, const Eigen::Vector3d& outward_mesh) {
  Match& m = matches_[i];
  m.usable = closest_[i].found();
  if (!m.usable) return;
  const auto faces = [&](const ClosestPoint& q) {
    return outward_mesh.dot(surface_->facets[q.triangle].normal.cast<double>()) >= rules_.facing_cos;
  };
  ClosestPoint q = closest_[i];
  const bool other_side = rules_.facing_cos > -1.0 && !faces(q);
  if (other_side) {
    // A thin part's back: from twice as far out its front may be the nearer one.
    q = surface_->bvh->closest_point(m.y_m + 2.0 * q.distance_m * outward_mesh);
    m.usable = q.found() && faces(q);
    if (!m.usable) return;
  }
  const RegistrationFacet& facet = surface_->facets[q.triangle];
  const Eigen::Vector3d facet_normal = facet.normal.cast<double>();
  const Eigen::Vector3d offset = m.y_m - q.p_m;
  const double along = offset.dot(facet_normal);
  m.distance_m = other_side ? along : std::copysign(q.distance_m, along);
  const bool leaning =
      q.barycentric.minCoeff() <= 0.0 && q.distance_m > rounding_m_ && std::abs(along) < kEdgeCos * q.distance_m;
  if (!other_side && leaning) {
    m.usable = !on_border(facet, q.barycentric);
    m.n = offset / m.distance_m;
  } else if (rules_.normals == RegistrationNormals::kInterpolated) {
    const Eigen::Vector3f n = static_cast<float>(q.barycentric(0)) * facet.corner_normal[0] +
                              static_cast<float>(q.barycentric(1)) * facet.corner_normal[1] +
                              static_cast<float>(q.barycentric(2)) * facet.corner_normal[2];
    m.n = n.cast<double>().normalized();
  } else {
    m.n = facet_normal;
  }
  if (rules_.max_distance_m > 0.0 && std::abs(m.distance_m) > rules_.max_distance_m) m.usable = false;
}

void Matcher::advance(const Vector6& motion, const Eigen::Vector3d& centre_m) {
  for (Match& m : matches_) {
    const Eigen::Vector3d step_m = motion.head<3>().cross(m.y_m - centre_m) + motion.tail<3>();
    m.y_m += step_m;
    m.distance_m += m.n.dot(step_m);
  }
}

double Matcher::scale_m() const {
  scratch_.clear();
  for (const Match& m : matches_) {
    if (m.usable) scratch_.push_back(std::abs(m.distance_m));
  }
  if (scratch_.empty()) return 0.0;
  const auto at = scratch_.begin() + static_cast<std::ptrdiff_t>(3 * scratch_.size() / 4);
  std::nth_element(scratch_.begin(), at, scratch_.end());
  return *at / 1.1503;  // the 75th percentile of |x| for normal x
}

}  // namespace asperity::registration
