#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/render/render_model.h"

namespace asperity {

// The edges of an object, vertices at one place taken as one, whose triangles have different textures or none, or
// one texture with coordinates that have a seam there. Where a surface ends (an edge of one triangle) no
// texture ends: there is nothing beside it. Time grows as that of a tree over the edges, whatever `fade_m` is.
TextureBorder make_texture_border(const RenderObject& object, const std::vector<RenderTexture>& textures,
                                  double fade_m);

// How much of its texture is felt at a point of a textured triangle: 0 at a border, 1 where the nearest is `fade_m`
// away or farther, in a straight line; 3t² - 2t³ between, so that the slope is continuous as well. Realtime-safe: yes.
double border_fade(const RenderObject& object, const Eigen::Vector3d& p_mesh_m, double fade_m) noexcept;

}  // namespace asperity
