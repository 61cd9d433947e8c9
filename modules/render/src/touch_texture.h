#pragma once

#include <Eigen/Core>

#include "asperity/render/device_state.h"
#include "asperity/render/proxy_state.h"
#include "asperity/render/render_model.h"
#include "asperity/render/texture_force.h"
#include "asperity/render/texture_state.h"
#include "evaluate_contacts.h"
#include "move_proxy.h"

namespace asperity {

// Where no surface pushes the proxy: notes the nearest textured place that the highest texture could reach as its
// touch, `over_texture` (seed §6.5: "touching only the surface profile of the texture"); or that there is none. A
// triangle without texture that is nearer hides it, `texture_hidden`.
void find_texture_below(const RenderModel& model, const ProxyBall& ball, ProxyState& proxy) noexcept;

// One step of the texture under the strongest touch, along the common normal of the touches. `v_proxy_mps`: of the
// proxy over the surface. `normal`: along which the force is to act.
TextureForce touch_texture(const RenderModel& model, const ProxyState& proxy, const ContactState& contact,
                           const Eigen::Vector3d& normal, const Eigen::Vector3d& v_proxy_mps, const DeviceState& device,
                           TextureState& state) noexcept;

}  // namespace asperity
