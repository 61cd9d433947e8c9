#pragma once

#include <string>
#include <vector>

#include "asperity/fidelity/path_grid.h"
#include "asperity/fidelity/render_stroke.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/render/render_model.h"
#include "asperity/scene/scene.h"
#include "asperity/texture/texture.h"

namespace asperity {

// A rendered surface along a line: what a contact has that renders k_s (depth + k_c H) (thesis §6.5 (4), (5)).
struct RenderedRelief {
  std::string name;
  double spacing_m = 0.025e-3;
  std::vector<double> height_m;  // k_c H; nan where there is no texture
  RenderedContact contact;
  bool stiffness_known = false;  // by the texture or scene; else the renderer's usual value
  bool friction_known = false;
  bool is_own = false;    // it was made from the stroke that it is compared with
  bool is_laid = false;   // over the stroke's own path: point i is point i of its grid
  std::string no_places;  // why its heights have no positions on the surface, in words; empty: they have
};

// Of a texture over at least `stroke_m` along x, at y = 0. A texture that repeats has `stroke_m` and one period.
// Throws Error for a texture without heights.
RenderedRelief relief_of_texture(const Texture& texture, double spacing_m, double stroke_m,
                                 const RenderConfig& otherwise);

// Of heights along a whole stroke, nan in gaps, as one series as `register` lays them (fit_fourier1d_path); stiffness,
// friction and k_c are those of `texture`. Throws Error as that function does.
RenderedRelief relief_of_heights(std::vector<double> height_m, double spacing_m, const Texture& texture,
                                 const RenderConfig& otherwise);

// Of a scene under the base path of a stroke that was measured over it (measure_on_scene): at each sample the heights
// of the texture of its triangle. Stiffness and friction are the means along the path. Throws Error if the scene has no
// registration or no texture under the path.
RenderedRelief relief_of_scene(const Scene& scene, const ProcessResult& result, const StrokeSignals& stroke,
                               const PathGrid& grid, const RenderConfig& otherwise);

}  // namespace asperity
