#pragma once

#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"
#include "asperity/render/render_model.h"
#include "asperity/render/render_step.h"
#include "asperity/scene/scene.h"

namespace asperity::render_test {

inline constexpr double kStiffness_N_per_m = 1000.0;

// How exactly a proxy has to settle on a flat surface: a point to 1 nm, a ball, which gets there in steps, to 1e-5 of
// its radius besides.
inline double settled_N(double tip_radius_m) { return kStiffness_N_per_m * (1e-9 + 1e-5 * tip_radius_m); }

// An object of a scene with nothing but its shape, in metres.
SceneObject object_of(const TriangleMesh& mesh);
Scene scene_of(const std::vector<TriangleMesh>& meshes);

// A rectangle in z = 0 about the origin, facing +z.
TriangleMesh sheet(double size_m, int cells, double jitter = 0.2);

// The surface z = slope |x| about the origin: a groove for a positive slope, a ridge for a negative one.
TriangleMesh fold(double slope, double size_m, int cells);

TriangleMesh moved(TriangleMesh mesh, const Eigen::Vector3d& by_m);
TriangleMesh scaled(TriangleMesh mesh, double by);

// A test for each radius of the tip, in metres.
class OfTipRadii : public testing::TestWithParam<double> {
 protected:
  double radius_m() const { return GetParam(); }
  RenderConfig config() const {
    RenderConfig config;
    config.tip_radius_m = radius_m();
    return config;
  }
};
// A point and two balls.
inline const auto kRadii_m = testing::Values(0.0, 0.5e-3, 2e-3);

// A model with one tip, stepped along straight lines.
struct Rig {
  explicit Rig(const Scene& scene, const RenderConfig& config = {}) : model(make_render_model(scene, config)) {}

  ServoOutput step(const Eigen::Vector3d& p_m);
  // From the last device point in steps of at most `step_m`; the last output.
  ServoOutput go(const Eigen::Vector3d& p_m, double step_m = 1e-4);

  RenderModel model;
  ServoState state;
  DeviceState device;
  bool begun = false;
};

}  // namespace asperity::render_test
