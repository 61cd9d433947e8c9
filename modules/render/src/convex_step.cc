#include "convex_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "triangle_foot.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr int kMostPlanes = 64;     // told to one projection
constexpr int kMostRetellings = 4;  // of projections without planes that proved false

// All lengths and planes are relative to the ball's centre, so that their rounding is small.
class Stepper {
 public:
  // cppcheck-suppress uninitMemberVar
  Stepper(std::span<const NearTriangle> triangles, const Ball& ball, const Vector3d& goal_m, std::int64_t most_work)
      : triangles_(triangles), ball_(ball), goal_m_(goal_m - ball.centre_m), most_work_(most_work) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const NearTriangle& t = triangles_[i];
      height_m_[i] = t.normal.dot(ball_.centre_m - t.a_m);
      known_[i] = 0;
    }
  }

  ConvexStep run(std::span<const std::uint32_t> first) {
    ConvexStep best;
    double best2 = 0.0;
    for (int telling = 0; telling <= kMostRetellings; ++telling) {
      const bool complete = project(first);
      ConvexStep step = finish(complete);
      const double left2 = (goal_m_ - (step.centre_m - ball_.centre_m)).squaredNorm();
      // Of the same place, take the planes of triangles that are really there.
      if (telling == 0 || (complete && left2 < best2) || (step.exact && left2 <= best2 * (1.0 + 0x1p-40)))
        best = step, best2 = left2;
      if (step.exact || !complete || work_ >= most_work_ || !forbid_false_faces(step)) break;
    }
    best.work = work_;
    return best;
  }

 private:
  // Not cleared beforehand, unlike a HalfSpace: a step uses few of them.
  struct KeptPlane {
    Vector3d normal;
    double offset_m;
  };
  static constexpr std::uint8_t kClosestKnown = 1, kNoFace = 2, kFootInside = 4;

  bool has_face(std::size_t i) const {
    return !(known_[i] & kNoFace) && std::abs(height_m_[i]) >= ball_.radius_m - 2.0 * ball_.slack_m;
  }

  HalfSpace face_plane(std::size_t i) const {
    const double side = height_m_[i] < 0.0 ? -1.0 : 1.0;
    return {side * triangles_[i].normal, offset(side * height_m_[i])};
  }

  double offset(double distance_m) const {
    const double offset_m = ball_.radius_m - distance_m;
    return lenient_ ? std::min(offset_m, 0.0) : offset_m;
  }

  HalfSpace closest_plane(std::size_t i) {
    KeptPlane& kept = closest_[i];
    if (known_[i] & kClosestKnown) return {kept.normal, kept.offset_m};
    const TriangleFoot foot = foot_on(triangles_[i], ball_.centre_m);
    known_[i] |= kClosestKnown;
    const double side = height_m_[i] < 0.0 ? -1.0 : 1.0;
    HalfSpace plane;
    if (foot.inside()) known_[i] |= kFootInside;
    if ((foot.inside() || !(foot.distance_m > 0.0)) && height_m_[i] != 0.0)
      plane = {side * triangles_[i].normal, offset(side * height_m_[i])};
    else
      plane = {foot.distance_m > 0.0 ? Vector3d(foot.from_m / foot.distance_m) : triangles_[i].normal,
               offset(foot.distance_m)};
    kept.normal = plane.normal, kept.offset_m = plane.offset_m;
    return plane;
  }

  // All of a triangle lies behind a plane that the projection keeps.
  bool is_covered(std::size_t i, const PlaneProjection& projection) const {
    const NearTriangle& t = triangles_[i];
    const Vector3d a_m = t.a_m - ball_.centre_m, b_m = t.b_m - ball_.centre_m, c_m = t.c_m - ball_.centre_m;
    for (int k = 0; k < projection.size(); ++k) {
      const HalfSpace& plane = projection.active(k).plane;
      const double limit_m = plane.offset_m - ball_.radius_m + ball_.slack_m;
      if (plane.normal.dot(a_m) <= limit_m && plane.normal.dot(b_m) <= limit_m && plane.normal.dot(c_m) <= limit_m)
        return true;
    }
    return false;
  }

  // How far y is behind the plane that a triangle should have, which is returned; not positive if it needs none.
  double violation(std::size_t i, const PlaneProjection& projection, HalfSpace& plane) {
    const bool face = has_face(i);
    double depth_m = 0.0;
    if (face) {
      plane = face_plane(i);
      depth_m = plane.depth_m(projection.x_m());
      if (depth_m <= ball_.slack_m) return 0.0;
    }
    if (is_covered(i, projection)) return 0.0;
    const HalfSpace closest = closest_plane(i);
    const double closest_depth_m = closest.depth_m(projection.x_m());
    if (closest_depth_m <= ball_.slack_m) return 0.0;
    if (face) return depth_m;
    plane = closest;
    return closest_depth_m;
  }

  bool project(std::span<const std::uint32_t> first) {
    lenient_ = false;
    if (try_project(first)) return true;
    if (!infeasible_ || work_ >= most_work_) return false;
    // Rounding left nothing between two walls: what already overlaps may stay as it is.
    lenient_ = true;
    for (std::size_t i = 0; i < triangles_.size(); ++i) known_[i] &= static_cast<std::uint8_t>(~kClosestKnown);
    return try_project(first);
  }

  bool try_project(std::span<const std::uint32_t> first) {
    infeasible_ = false;
    projection_ = PlaneProjection(goal_m_);
    int told = 0;
    for (const std::uint32_t i : first) {
      const HalfSpace plane = closest_plane(i);
      if (plane.offset_m < -2.0 * ball_.slack_m || !(known_[i] & kFootInside)) continue;  // it does not touch a face
      if (plane.depth_m(projection_.x_m()) <= ball_.slack_m) continue;
      if (!projection_.add(plane, static_cast<int>(i))) return infeasible_ = true, false;
      ++told;
    }
    for (; told < kMostPlanes && work_ < most_work_; ++told) {
      work_ += static_cast<std::int64_t>(triangles_.size());
      std::size_t worst = triangles_.size();
      double worst_m = 0.0;
      HalfSpace plane, worst_plane;
      for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const double depth_m = violation(i, projection_, plane);
        if (depth_m > worst_m) worst = i, worst_m = depth_m, worst_plane = plane;
      }
      if (worst == triangles_.size()) return true;
      if (!projection_.add(worst_plane, static_cast<int>(worst))) return infeasible_ = true, false;
    }
    return false;
  }

  // How much of the way to y no triangle bars.
  double free_part(const Vector3d& y) {
    double part = 1.0;
    HalfSpace plane;
    work_ += static_cast<std::int64_t>(triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (!(violation(i, projection_, plane) > 0.0)) continue;
      const auto part_of = [&](const HalfSpace& p) {
        const double end_m = p.normal.dot(y);
        return p.offset_m < 0.0 && end_m < p.offset_m ? p.offset_m / end_m : 0.0;
      };
      part = std::min(part, std::max(has_face(i) ? part_of(face_plane(i)) : 0.0, part_of(closest_plane(i))));
    }
    return part;
  }

  ConvexStep finish(bool complete) {
    ConvexStep step;
    const Vector3d y = complete ? projection_.x_m() : Vector3d(free_part(projection_.x_m()) * projection_.x_m());
    step.centre_m = ball_.centre_m + y;
    step.exact = complete;
    step.failed = !complete;
    const double beside_m = ball_.slack_m + 0x1p-20 * (goal_m_ - y).norm();
    for (int k = 0; k < projection_.size(); ++k) {
      const PlaneProjection::Active& active = projection_.active(k);
      if (!(active.multiplier_m > 0.0)) continue;
      auto& touch = step.touches[static_cast<std::size_t>(step.touch_count++)];
      touch.index = static_cast<std::uint32_t>(active.tag);
      told_by_[static_cast<std::size_t>(step.touch_count - 1)] = touch.index;
      touch.normal = active.plane.normal;
      touch.pull_m = active.multiplier_m;
      TriangleFoot foot = foot_on(triangles_[touch.index], step.centre_m);
      // On a round the plane of before is no longer quite that of the place now.
      const auto beside = [&](const TriangleFoot& f) { return (f.from_m - ball_.radius_m * touch.normal).norm(); };
      if (!(beside(foot) <= beside_m)) find_in_plane(step.centre_m, touch, foot, beside(foot), beside);
      touch.barycentric = foot.barycentric;
      false_[static_cast<std::size_t>(step.touch_count - 1)] = !(beside(foot) <= beside_m);
      if (false_[static_cast<std::size_t>(step.touch_count - 1)]) step.exact = false;
    }
    return step;
  }

  // Where a flat part of the surface has several triangles, any of them may have given the plane; the one under the
  // ball is meant.
  template <class Beside>
  void find_in_plane(const Vector3d& centre_m, ConvexStep::Touch& touch, TriangleFoot& foot, double best_m,
                     const Beside& beside) const {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const NearTriangle& t = triangles_[i];
      if (!(std::abs(touch.normal.dot(t.normal)) >= 1.0 - 0x1p-44)) continue;
      if (!(std::abs(touch.normal.dot(centre_m - t.a_m) - ball_.radius_m) <= ball_.slack_m)) continue;
      const TriangleFoot other = foot_on(t, centre_m);
      const double beside_m = beside(other);
      if (!(beside_m < best_m)) continue;
      touch.index = static_cast<std::uint32_t>(i);
      foot = other;
      best_m = beside_m;
    }
  }

  // Whether one of the planes that held the ball was that of a face beside which the ball now is, and was not yet
  // forbidden. All faces of the same plane are: find_in_plane() has found none under the ball.
  bool forbid_false_faces(const ConvexStep& step) {
    bool any = false;
    for (int k = 0; k < step.touch_count; ++k) {
      const std::uint32_t i = told_by_[static_cast<std::size_t>(k)];
      if (!false_[static_cast<std::size_t>(k)] || !has_face(i)) continue;
      for (std::size_t other = 0; other < triangles_.size(); ++other) {
        if (std::abs(triangles_[i].normal.dot(triangles_[other].normal)) >= 1.0 - 0x1p-44 &&
            std::abs(std::abs(height_m_[i]) - std::abs(height_m_[other])) <= 2.0 * ball_.slack_m)
          known_[other] |= kNoFace;
      }
      known_[i] |= kNoFace;
      any = true;
    }
    return any;
  }

  std::span<const NearTriangle> triangles_;
  const Ball& ball_;
  Vector3d goal_m_;
  PlaneProjection projection_{Vector3d::Zero()};
  std::int64_t most_work_, work_ = 0;
  bool lenient_ = false, infeasible_ = false;
  std::array<bool, 3> false_{};
  std::array<std::uint32_t, 3> told_by_{};  // whose plane each touch is; find_in_plane() may name another triangle
  std::array<double, NearTriangles::kMost> height_m_;  // of the centre over each triangle's plane
  std::array<std::uint8_t, NearTriangles::kMost> known_;
  std::array<KeptPlane, NearTriangles::kMost> closest_;
};

}  // namespace

ConvexStep convex_step(std::span<const NearTriangle> triangles, const Ball& ball, const Vector3d& goal_m,
                       std::span<const std::uint32_t> first, std::int64_t most_work) noexcept {
  return Stepper(triangles, ball, goal_m, most_work).run(first);
}

}  // namespace asperity
