#pragma once

#include <cstdint>

#include "asperity/render/render_texture.h"

namespace asperity {

// A number for what a texture feels like: the same for the same model, numbers and way of rendering, another for
// others but for a chance of 2⁻⁶⁴. Never 0.
std::uint64_t texture_id(const RenderTexture& texture);

}  // namespace asperity
