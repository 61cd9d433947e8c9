#include "asperity/device/cap_scene.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/device/device_caps.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

DeviceInfo touch() {
  DeviceInfo info;
  info.name = "openhaptics";
  info.model = "Touch";
  info.max_force_N = 3.3;
  info.max_stiffness_N_per_m = 2300.0;
  info.bandwidth_Hz = 100.0;
  return info;
}

// A sine of 2.5 mm pitch and 0.5 mm height from its lowest to its highest point, on one triangle.
Scene sine_scene() {
  Scene scene;
  SceneObject object;
  object.mesh.vertices = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  SceneTexture laid;
  laid.texture.name = "sine";
  Fourier1d sine;
  sine.length_mm = 2.5;
  sine.a_m = {0.25e-3};
  sine.b_m = {0.0};
  laid.texture.model = sine;
  object.textures.push_back(laid);
  scene.objects.push_back(object);
  return scene;
}

TEST(DeviceCaps, FollowTheirFormulas) {
  const DeviceCaps caps = find_device_caps(touch(), ServoConfig{}, DeviceCapsConfig{});
  EXPECT_EQ(caps.force_N, 3.3);
  EXPECT_EQ(caps.stiffness_N_per_m, 2300.0);
  EXPECT_THAT(caps.stiffness_reason, HasSubstr("Touch at 1000 Hz renders at most 2300 N/m"));
  EXPECT_DOUBLE_EQ(caps.texture_stiffness_N_per_m, 450.0);
  EXPECT_DOUBLE_EQ(caps.texture_cycles_per_mm, 1.0);  // 100 Hz at 100 mm/s
}

TEST(DeviceCaps, OfADeviceThatStatesNothing) {
  DeviceInfo unknown;
  unknown.rate_Hz = 4000.0;
  ServoConfig servo;
  const DeviceCapsConfig config;
  DeviceCaps caps = find_device_caps(unknown, servo, config);
  EXPECT_EQ(caps.force_N, servo.safety.max_force_N);
  EXPECT_DOUBLE_EQ(caps.stiffness_N_per_m, 2000.0);  // 2 · 1 N s/m / 1 ms: the controller's damping is not counted
  EXPECT_THAT(caps.stiffness_reason, HasSubstr("Colgate"));
  EXPECT_EQ(caps.texture_cycles_per_mm, DeviceCaps::kNone);
  servo.rate_Hz = 4000.0;
  caps = find_device_caps(unknown, servo, config);
  EXPECT_DOUBLE_EQ(caps.stiffness_N_per_m, 8000.0);
  EXPECT_DOUBLE_EQ(caps.texture_stiffness_N_per_m, 1800.0);
  servo.safety.assumed_damping_N_s_per_m = 0.0;
  EXPECT_EQ(find_device_caps(unknown, servo, config).stiffness_N_per_m, DeviceCaps::kNone);
  servo.safety.assumed_damping_N_s_per_m = 0.02;
  caps = find_device_caps(unknown, servo, config);
  EXPECT_DOUBLE_EQ(caps.stiffness_N_per_m, 160.0);
  EXPECT_DOUBLE_EQ(caps.texture_stiffness_N_per_m, 160.0);
}

// A loop that is faster than the device does not make the device faster; a slower one makes it slower.
TEST(DeviceCaps, CountTheSlowerRate) {
  ServoConfig servo;
  servo.rate_Hz = 4000.0;
  DeviceCaps caps = find_device_caps(touch(), servo, DeviceCapsConfig{});
  EXPECT_EQ(caps.stiffness_N_per_m, 2300.0);
  EXPECT_DOUBLE_EQ(caps.texture_stiffness_N_per_m, 450.0);
  servo.rate_Hz = 500.0;
  caps = find_device_caps(touch(), servo, DeviceCapsConfig{});
  EXPECT_DOUBLE_EQ(caps.stiffness_N_per_m, 1150.0);
  EXPECT_DOUBLE_EQ(caps.texture_stiffness_N_per_m, 225.0);
}

// A scene ten times as large as the hand's motion feels ten times as stiff and as fine.
TEST(DeviceCaps, AreThoseOfTheHand) {
  ServoConfig servo;
  servo.frame.scale = 10.0;
  const DeviceCaps caps = find_device_caps(touch(), servo, DeviceCapsConfig{});
  EXPECT_DOUBLE_EQ(caps.stiffness_N_per_m, 230.0);
  EXPECT_THAT(caps.stiffness_reason, HasSubstr("a metre of the hand is 10 m of the scene"));
  EXPECT_DOUBLE_EQ(caps.texture_stiffness_N_per_m, 45.0);
  EXPECT_DOUBLE_EQ(caps.texture_cycles_per_mm, 0.1);
  EXPECT_EQ(caps.force_N, 3.3);
}

TEST(CapScene, LeavesAloneWhatADeviceCan) {
  Scene scene = sine_scene();
  scene.objects[0].textures[0].texture.compliance_kc = 0.4;
  const CappedScene capped =
      cap_scene(scene, RenderConfig{}, find_device_caps(touch(), ServoConfig{}, DeviceCapsConfig{}));
  EXPECT_THAT(capped.warnings, IsEmpty());
  EXPECT_EQ(capped.config.stiffness_N_per_m, RenderConfig{}.stiffness_N_per_m);
  EXPECT_EQ(capped.scene.objects[0].textures[0].texture.compliance_kc, 0.4);
  EXPECT_EQ(capped.config.texture.cutoff_cycles_per_mm, 0.0);
}

TEST(CapScene, LowersStiffnessEverywhere) {
  Scene scene = sine_scene();
  scene.stiffness_N_per_m = 5000.0;
  scene.objects[0].textures.clear();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  scene.objects[0].material.vertices = {{nan, 8000.0, nan}, {nan, 100.0, nan}, {nan, nan, nan}};
  const CappedScene capped =
      cap_scene(scene, RenderConfig{}, find_device_caps(touch(), ServoConfig{}, DeviceCapsConfig{}));
  EXPECT_THAT(capped.warnings, ElementsAre(HasSubstr("stiffness lowered from 8000 to 2300 N/m: Touch")));
  EXPECT_EQ(capped.scene.stiffness_N_per_m, 2300.0);
  const auto& vertices = capped.scene.objects[0].material.vertices;
  EXPECT_EQ(vertices[0].stiffness_N_per_m, 2300.0);
  EXPECT_EQ(vertices[1].stiffness_N_per_m, 100.0);
  EXPECT_TRUE(std::isnan(vertices[2].stiffness_N_per_m));
}

TEST(CapScene, LowersTheTexturesSpring) {
  const CappedScene capped =
      cap_scene(sine_scene(), RenderConfig{}, find_device_caps(touch(), ServoConfig{}, DeviceCapsConfig{}));
  EXPECT_THAT(capped.warnings, ElementsAre(HasSubstr("texture 'sine': its spring lowered to 450 N/m")));
  EXPECT_DOUBLE_EQ(*capped.scene.objects[0].textures[0].texture.compliance_kc, 0.45);
}

TEST(CapScene, LowersATexturesAmplitudeToTheForce) {
  DeviceInfo weak = touch();
  weak.max_force_N = 0.1;
  const CappedScene capped =
      cap_scene(sine_scene(), RenderConfig{}, find_device_caps(weak, ServoConfig{}, DeviceCapsConfig{}));
  EXPECT_THAT(capped.warnings, ElementsAre(HasSubstr("450 N/m"), HasSubstr("0.5 mm would exceed 0.1 N")));
  // k_c k_s H = 0.1 N with k_s = 1 N/mm and H = 0.5 mm; the highest point is known to a bound of 1 %.
  EXPECT_NEAR(*capped.scene.objects[0].textures[0].texture.compliance_kc, 0.2, 0.002);
}

TEST(CapScene, LowersTheCutOff) {
  Scene scene = sine_scene();
  std::get<Fourier1d>(scene.objects[0].textures[0].texture.model).length_mm = 0.5;
  RenderConfig config;
  const DeviceCaps caps = find_device_caps(touch(), ServoConfig{}, DeviceCapsConfig{});
  scene.objects[0].textures[0].texture.compliance_kc = 0.4;
  EXPECT_DOUBLE_EQ(highest_cycles_per_mm(scene.objects[0].textures[0].texture), 2.0);
  CappedScene capped = cap_scene(scene, config, caps);
  EXPECT_THAT(capped.warnings, ElementsAre(HasSubstr("may hold 2 cycles/mm, rendered up to 1")));
  EXPECT_DOUBLE_EQ(capped.config.texture.cutoff_cycles_per_mm, 1.0);
  config.texture.cutoff_cycles_per_mm = 0.5;
  capped = cap_scene(scene, config, caps);
  EXPECT_THAT(capped.warnings, IsEmpty());
  EXPECT_DOUBLE_EQ(capped.config.texture.cutoff_cycles_per_mm, 0.5);
  scene.objects[0].textures[0].texture.band_cycles_per_mm = {0.1, 0.9};
  config.texture.cutoff_cycles_per_mm = 0.0;
  EXPECT_DOUBLE_EQ(cap_scene(scene, config, caps).config.texture.cutoff_cycles_per_mm, 0.0);
}

}  // namespace
}  // namespace asperity
