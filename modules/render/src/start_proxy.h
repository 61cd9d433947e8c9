#pragma once

#include <Eigen/Core>

#include "asperity/render/proxy_state.h"
#include "asperity/render/render_model.h"
#include "move_proxy.h"

namespace asperity {

// True if the point is inside a closed object: a ray from it crosses that object's surface an odd number of times,
// by the majority of five directions, so that a ray along an edge or past a flaw does not decide.
// Realtime-safe: yes.
bool is_inside(const RenderModel& model, const Eigen::Vector3d& p_world_m) noexcept;

// Sets the proxy to the device point where that is free: outside closed objects, with the ball off all surfaces. False
// as long as it is not and the proxy was not started before: then nothing is to be felt. A model with other objects
// than in the step before starts it anew.
bool start_proxy(const RenderModel& model, const ProxyBall& ball, const Eigen::Vector3d& p_world_m,
                 ProxyState& proxy) noexcept;

}  // namespace asperity
