#pragma once

#include <array>

#include <Eigen/Core>

#include "asperity/render/render_texture.h"

namespace asperity {

// True if the heights of a texture step across an edge whose two ends have coordinates a_m in one triangle and b_m in
// the other: if they differ, at either end, by more than 10⁻⁴ of the edge's length in the texture and 10⁻⁶ of the
// coordinates (what files round away), and not by the same whole number of periods at both. Coordinates that the
// heights do not depend on do not count: none of them for a series, nor y for a model of x alone.
bool is_torn(const RenderTexture& texture, const std::array<Eigen::Vector2d, 2>& a_m,
             const std::array<Eigen::Vector2d, 2>& b_m);

}  // namespace asperity
