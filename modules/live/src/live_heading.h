#pragma once

#include <cstdint>
#include <deque>

#include <Eigen/Core>

namespace asperity {

// The direction of travel of a path that is still growing: over half a span before and half a span after a point, for
// which the way ahead is given. At rest the direction is held (measure_arc_length.h). Thread-safe: no.
class LiveHeading {
 public:
  LiveHeading(double span_s, double rest_speed_mps, double rest_fraction);

  // The next point of the path, how far the tip goes in the half span after it, and the surface's normal there (zero:
  // unknown). The unit direction along the surface, zero as long as the tip has not moved.
  Eigen::Vector3d push(std::int64_t t_ns, const Eigen::Vector3d& p_m, const Eigen::Vector3d& ahead_m,
                       const Eigen::Vector3d& normal);
  // Along the surface, over the span.
  double speed_mps() const { return speed_mps_; }

  void forget_path();
  void forget_direction() { direction_.setZero(); }

 private:
  struct Point {
    std::int64_t t_ns;
    Eigen::Vector3d p_m;
  };
  double span_s_;
  double rest_speed_mps_;
  double rest_fraction_;
  double usual_mps_ = 0.0;  // while it moves
  std::deque<Point> behind_;
  std::int64_t last_ns_ = 0;
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();
  double speed_mps_ = 0.0;
};

}  // namespace asperity
