#pragma once

#include <Eigen/Core>

#include "asperity/render/proxy_state.h"
#include "asperity/render/render_model.h"
#include "gather_triangles.h"

namespace asperity {

inline constexpr double kSkin = 0x1p-24;  // thickness of the proxy's skin in extents of the model

// The proxy as a ball, and how finely it is placed.
struct ProxyBall {
  double radius_m = 0.0;  // of the tip and its skin
  double slack_m = 0.0;   // rounding: distances that differ by less are equal
  double coarse_m = 0.0;  // a length to begin with when it is unknown how far to look for triangles
  double stride_m = 0.0;  // how far the hand went in this step
  double skin_m = 0.0;
};

// Moves the proxy to the local minimum of its distance to the goal that it reaches without passing through any
// triangle of the given objects, and notes where it touches. Each iteration is safe; where the way is long the bounded
// number of iterations may end before the minimum, and the next call goes on from there. False if it ended so.
bool move_proxy(const RenderModel& model, const ProxyBall& ball, const Eigen::Vector3d& goal_m, ObjectSet objects,
                ProxyState& proxy) noexcept;

// Makes sure that the proxy's list holds all triangles within `distance_m` of it, if they are not too many.
void ensure_triangles_within(const RenderModel& model, const ProxyBall& ball, double distance_m, ObjectSet objects,
                             ProxyState& proxy) noexcept;

}  // namespace asperity
