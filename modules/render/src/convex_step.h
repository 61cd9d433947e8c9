#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "asperity/render/near_triangles.h"
#include "project_on_planes.h"

namespace asperity {

// A ball among triangles.
struct Ball {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  double slack_m = 0.0;  // by how much it may overlap them: rounding
};

// A step of a ball from where it is towards a goal.
struct ConvexStep {
  struct Touch {
    std::uint32_t index = 0;  // of the triangle in the list
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();  // of the triangle's point nearest to the ball
    double pull_m = 0.0;
  };
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  int touch_count = 0;
  std::array<Touch, 3> touches;
  bool exact = false;     // no nearer place can be reached from here: every plane that holds the ball touches it
  bool failed = false;    // the planes left no place: some only touch each other within rounding
  std::int64_t work = 0;  // evaluations of triangles
};

// Moves a ball that overlaps no triangle to the point nearest to the goal of a convex polytope that contains the
// ball's centre and whose points are all farther than the radius from every triangle: so the ball may go there in a
// straight line. `first`: triangles that the ball is expected to touch, by their places in the list. After about
// `most_work` evaluations of triangles it goes as far as it knows to be free.
ConvexStep convex_step(std::span<const NearTriangle> triangles, const Ball& ball, const Eigen::Vector3d& goal_m,
                       std::span<const std::uint32_t> first, std::int64_t most_work) noexcept;

}  // namespace asperity
