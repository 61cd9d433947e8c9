#pragma once

#include "asperity/render/texture_force.h"

namespace asperity {

// The forces of a height field H(x, y) on a tip z above the geometric surface. All vanish continuously at z = H.
// Realtime-safe: yes.

// k_c k_s Δh n, Δh = clamp(H − z, 0, H): seed §6.5 (5), errata 19 and 20.
TextureForce height_force(const RenderTexture& texture, const TextureTouch& touch) noexcept;

// k_c k_s Δh m, m the unit normal of the height field: n − ∇H, normalised (Ho, Basdogan and Srinivasan 1999).
TextureForce normal_perturbation_force(const RenderTexture& texture, const TextureTouch& touch) noexcept;

// −k ∇H within the surface (Minsky 1995), k the load on the place: k_c (k_s d + k_s Δh), in newtons. That is minus the
// gradient of the elastic energy ½ k_s (H − z)² over the surface, times k_c.
TextureForce lateral_gradient_force(const RenderTexture& texture, const TextureTouch& touch) noexcept;

}  // namespace asperity
