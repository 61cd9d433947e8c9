#pragma once

#include <Eigen/Core>

#include "asperity/render/proxy_state.h"
#include "asperity/render/render_model.h"
#include "gather.h"
#include "proxy_ball.h"

namespace asperity {

// Moves the proxy to the local minimum of its distance to the goal that it reaches without passing through any
// triangle of the given objects, and notes where it touches. Each iteration is safe; where the way is long the bounded
// number of iterations may end before the minimum, and the next call goes on from there. False if it ended so.
bool move_proxy(const RenderModel& model, const ProxyBall& ball, const Eigen::Vector3d& goal_m, ObjectSet objects,
                ProxyState& proxy) noexcept;

// Makes sure that the proxy's list holds all triangles within `distance_m` of it, if they are not too many.
void look_around(const RenderModel& model, const ProxyBall& ball, double distance_m, ObjectSet objects,
                 ProxyState& proxy) noexcept;

}  // namespace asperity
