#pragma once

#include "asperity/render/render_model.h"
#include "asperity/scene/scene.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// What the page draws of a scene (docs/studio-feel.md): per object k the arrays "vertices_k" (f32, n × 3, metres of the
// scene's world), "triangles_k" (u32, m × 3), "texture_k" (i32, m: place in the head's textures, -1: none) and
// "xy_k" (f32, m × 6, metres: haptic coordinates of the corners); per texture t with heights "height_t" (f32, rows ×
// columns, metres, with the offset with which it is rendered) over one period or the whole of it, whose size the head
// states. Throws Error for a scene beyond kMostDrawnTriangles, in words.
BlockWriter make_scene_block(const Scene& scene, const RenderModel& model);

inline constexpr std::size_t kMostDrawnTriangles = 4'000'000;

}  // namespace asperity::studio
