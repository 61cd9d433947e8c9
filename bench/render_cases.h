#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"
#include "asperity/render/render_model.h"
#include "asperity/scene/scene.h"

namespace bench {

inline constexpr double kSphere_m = 50e-3;
inline constexpr double kDepth_m = 1e-3;
inline constexpr double kStiffness_N_per_m = 1000.0;
inline constexpr double kTick_s = 1e-3;
inline constexpr double kFriction = 0.3;
inline constexpr double kStaticRatio = 1.2;

inline constexpr int kFrequency70k = 59;  // 69,620 triangles
inline constexpr int kFrequency1M = 224;  // 1,003,520

// That mesh as a scene; with `textured` all of it has a Fourier texture of 128 harmonics, 0.1 mm of RMS, x and y of
// the mesh its coordinates.
asperity::Scene scene_of(const asperity::TriangleMesh& mesh, bool textured);

asperity::RenderConfig config_of(double tip_m, bool friction);

}  // namespace bench
