#pragma once

#include "asperity/render/proxy_state.h"
#include "asperity/render/render_model.h"
#include "move_proxy.h"

namespace asperity {

// Where objects have moved since the step before, the proxy goes with them, one object after another: with an object
// that it touches as if glued to it (friction then decides what it really does), else as far as the object's surface
// pushes it, which is found in the frame of the object, where the surface rests and the proxy moves. It never
// passes through what has moved, but what rests stops it: a proxy that is pinched between two objects stays clear of
// the one that rests or was moved first, and the other closes over it.
void follow_moving_objects(const RenderModel& model, const ProxyBall& ball, ProxyState& proxy) noexcept;

}  // namespace asperity
