#pragma once

#include "asperity/render/render_texture.h"

namespace asperity {

// Fills grains, grain_stiffness_N_per_m, lift_m and highest_m of a texture to be rendered as kStochastic.
void make_grains(RenderTexture& texture);

}  // namespace asperity
