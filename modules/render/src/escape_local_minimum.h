#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/render/proxy_state.h"
#include "move_proxy.h"

namespace asperity {

// A point tip is a ball as small as its skin. Where convex and concave edges meet in a vertex such a ball can rest in
// a local minimum of its own size, behind a hump that a point would not notice. Where a triangle about the ball goes on
// to a place nearer to the goal, the proxy is set there: some radii along that triangle and a little above it, if that
// is nearer to the goal and the way there, straight or over a point above the local minimum, passes no triangle of the
// list, which must be complete. False if there is no such place, the proxy rests rightly, or if `work` has run out,
// from which the evaluations of triangles are taken.
bool escape_local_minimum(ProxyState& proxy, const ProxyBall& ball, const Eigen::Vector3d& goal_m,
                          std::int64_t& work) noexcept;

}  // namespace asperity
