#pragma once

#include "asperity/render/render_texture.h"

namespace asperity {

// Fills x_table and y_table where the texture is a Fourier series or a product of two, grid where it is an image or a
// spline.
void make_tables(RenderTexture& texture);

}  // namespace asperity
