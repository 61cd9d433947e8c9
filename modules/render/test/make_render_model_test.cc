#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/testkit/shape_meshes.h"
#include "scenes.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing_render::scene_of;

std::string error_of(const Scene& scene, const RenderConfig& config) {
  try {
    make_render_model(scene, config);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(MakeRenderModel, SaysWhatCannotBeRendered) {
  const Scene scene = scene_of(testkit::plane_mesh({0.1, 0.1}, 4, 4));
  EXPECT_THAT(error_of({}, {}), HasSubstr("without objects"));
  RenderConfig config;
  config.stiffness_N_per_m = -2.0;
  EXPECT_THAT(error_of(scene, config), HasSubstr("stiffness: -2"));
  Scene wrong = scene;
  wrong.objects[0].mesh.haptic.resize(3);
  EXPECT_THAT(error_of(wrong, {}), HasSubstr("object 0 (test): 3 haptic triangles for 32"));
  for (const double far_m : {-1e300, 1e6}) {
    Scene far = scene;
    far.objects[0].mesh.vertices[7].x() = far_m;
    EXPECT_THAT(error_of(far, {}), HasSubstr("vertex 7 at"));
  }
}

TEST(MakeRenderModel, KnowsWhatIsClosedAndItsMaterial) {
  Scene scene = scene_of(testkit::box_mesh({0.1, 0.1, 0.1}, 3));
  scene.friction = 0.25;
  const RenderModel model = make_render_model(scene, {});
  EXPECT_TRUE(model.objects[0].closed);
  ASSERT_EQ(model.objects[0].materials.size(), 1u);
  EXPECT_TRUE(model.objects[0].corner_material.empty());
  EXPECT_EQ(model.objects[0].materials[0].friction, 0.25);
  EXPECT_EQ(model.objects[0].materials[0].stiffness_N_per_m, 1000.0);
  EXPECT_EQ(model.objects[0].materials[0].compliance_kc, 1.0);
  EXPECT_FALSE(make_render_model(scene_of(testkit::plane_mesh({0.1, 0.1}, 4, 4)), {}).objects[0].closed);
}

// A vertex without a value in the map has one value in all its triangles, or an edge that runs to it would be a step.
TEST(MakeRenderModel, FillsAnUnknownMaterialOncePerVertex) {
  Scene scene = scene_of(testkit::plane_mesh({0.1, 0.1}, 4, 4));
  const auto& triangles = scene.objects[0].mesh.triangles;
  auto& map = scene.objects[0].material.vertices;
  map.resize(scene.objects[0].mesh.vertices.size());
  for (std::size_t v = 0; v < map.size(); ++v) {
    if (v % 3 != 0) map[v].stiffness_N_per_m = 400.0 + 10.0 * static_cast<double>(v);
  }
  const RenderModel model = make_render_model(scene, {});
  std::vector<double> value(map.size(), -1.0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double stiffness = model.objects[0].materials[model.objects[0].corner_material[t][k]].stiffness_N_per_m;
      double& first = value[triangles[t][k]];
      if (first < 0.0) first = stiffness;
      EXPECT_EQ(stiffness, first) << "triangle " << t << " vertex " << triangles[t][k];
      EXPECT_LE(stiffness, 400.0 + 10.0 * static_cast<double>(map.size()));
    }
  }
}

}  // namespace
}  // namespace asperity
