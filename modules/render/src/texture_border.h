#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/render/render_model.h"

namespace asperity {

// The edges of an object, vertices at one place taken as one, whose triangles have different textures or none; for
// each textured triangle those within `fade_m`, at most 64 of the nearest. Where a surface ends (an edge of one
// triangle) no texture ends: there is nothing beside it.
TextureBorder make_texture_border(const RenderObject& object, double fade_m);

// How much of its texture is felt at a point of a triangle: 0 at the border of the area, 1 where that is `fade_m` away
// or farther, in a straight line; 3t² - 2t³ between, so that the slope is continuous as well. Realtime-safe: yes.
double border_fade(const RenderObject& object, std::uint32_t triangle, const Eigen::Vector3d& p_mesh_m,
                   double fade_m) noexcept;

}  // namespace asperity
