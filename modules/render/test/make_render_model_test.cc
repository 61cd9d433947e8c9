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

}  // namespace
}  // namespace asperity
