#include "asperity/fidelity/check_renderer.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "feel_test_scene.h"

namespace asperity {
namespace {

constexpr double kForce_N = 0.5, kSpeed_mps = 0.025;
// Where the scan begins over the mesh's x: the wave is zero there, so the band-pass, which continues its ends by odd
// reflection, sees it go on, and its RMS is the sine's. At a crest the reflection bends it, 1.3 % more.
constexpr double kStart_m = 5.625e-3;

// A scan of the plate's wave along its middle for 70 mm at 4 kHz, without error; the tracker's world is turned
// and moved against the mesh. `wave(x)` is the height that was measured at the mesh's x.
template <class Wave>
ProcessResult scan(const Pose& T_world_mesh, Wave wave) {
  ProcessResult out;
  TipMotion& motion = out.trajectory.motion;
  constexpr double kRate_Hz = 4000.0, kLength_m = 70e-3;
  const auto count = static_cast<int>(kLength_m / kSpeed_mps * kRate_Hz);
  const Eigen::Vector3d n_world = T_world_mesh.rotation * Eigen::Vector3d::UnitZ();
  for (int i = 0; i <= count; ++i) {
    const double s_m = kSpeed_mps * i / kRate_Hz;
    const Eigen::Vector3d base_m = T_world_mesh * Eigen::Vector3d(kStart_m + s_m, 10e-3, 0.0);
    motion.t_ns.push_back(std::llround(1e9 * i / kRate_Hz) + 77);
    motion.p_world_tip_m.push_back(base_m + wave(kStart_m + s_m) * n_world);
    // A reading in ten.
    motion.force_N.push_back(i % 10 == 0 ? kForce_N : std::nan(""));
    out.base.path.p_world_m.push_back(base_m);
    out.base.path.n_world.push_back(n_world);
    out.base.path.s_m.push_back(s_m);
    out.base.contact.push_back(1);
  }
  for (double s_m = 0.0; s_m <= kLength_m; s_m += out.profile.spacing_m) {
    out.profile.s_m.push_back(s_m);
    out.profile.height_m.push_back(wave(kStart_m + s_m));
  }
  out.speed.mean_mps = kSpeed_mps;
  return out;
}

const Pose kTracker{Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized())),
                    {0.1, -0.2, 0.3}};

Scene registered_plate(double length_mm) {
  Scene scene = feel_test::plate(length_mm);
  scene.T_mesh_world = kTracker.inverse();
  return scene;
}

RendererCheck score(const Scene& scene, const ProcessResult& measured) {
  return check_renderer(measured, press_in_scan(measured, scene, 1000.0), make_render_model(scene, {}), 1000.0, {});
}

TEST(PressInScan, TheDepthIsTheForceOverTheStiffnessOfThePlace) {
  Scene scene = registered_plate(80.0);
  ProcessResult measured = scan(kTracker, feel_test::wave_m);
  for (std::size_t i = 0; i < 100; ++i) measured.base.contact[i] = 0;
  for (const double k_N_per_m : {1000.0, 400.0}) {
    if (k_N_per_m == 400.0) scene.objects[0].textures[0].texture.stiffness_N_per_m = k_N_per_m;
    const PressedScan pressed = press_in_scan(measured, scene, 1000.0);
    ASSERT_EQ(pressed.path.size(), measured.trajectory.motion.size() + 100);
    EXPECT_NEAR(pressed.path.p_world_m[0].z(), 1e-3, 1e-12) << "comes down from above";
    EXPECT_NEAR(pressed.path.p_world_m[150].z(), std::max(feel_test::wave_m(pressed.path.p_world_m[150].x()), 0.0),
                1e-12)
        << "out of contact";
    for (std::size_t i = 300; i < pressed.path.size(); i += 111) {
      EXPECT_NEAR(pressed.path.p_world_m[i].z(), -kForce_N / k_N_per_m, 1e-12);
      EXPECT_NEAR(pressed.path.p_world_m[i].x(), kStart_m + pressed.s_m[i], 1e-12);
      EXPECT_EQ(pressed.path.t_ns[i], 100'000'000 + measured.trajectory.motion.t_ns[i - 100] - 77);
    }
  }
  scene.T_mesh_world.reset();
  EXPECT_THROW(press_in_scan(measured, scene, 1000.0), Error);
}

// The wave, and what else a texture could make of it: the plate's own series times `factor`.
Scene plate_times(double length_mm, double factor) {
  Scene scene = registered_plate(length_mm);
  std::get<Fourier1d>(scene.objects[0].textures[0].texture.model).a_m.back() *= factor;
  return scene;
}

TEST(CheckRenderer, AFaithfulTextureHasTheScansHeights) {
  const RendererCheck result = score(registered_plate(80.0), scan(kTracker, feel_test::wave_m));
  EXPECT_TRUE(result.phase_known);
  EXPECT_GT(result.correlation, 0.9999);
  EXPECT_NEAR(result.gain, 1.0, 2e-3);
  EXPECT_NEAR(result.shift_m, 0.0, 5e-6);
  EXPECT_NEAR(result.height.rms_ratio, 1.0, 2e-3);
  EXPECT_LT(result.height.distance_dB, 0.1);
  EXPECT_LT(result.force.distance_dB, 0.1);
  EXPECT_NEAR(result.contact_fraction, 1.0, 1e-12);
  EXPECT_GT(result.score, 0.97);
  EXPECT_TRUE(result.trustworthy);
  // The texture's spring alone: k_c k_s of the cosine; what was measured does not vary.
  constexpr double kRms_N = 1000.0 * feel_test::kAmplitude_m / 1.4142135623730951;
  EXPECT_NEAR(result.force.rendered_rms, kRms_N, 0.005 * kRms_N);
  EXPECT_NEAR(result.measured_force.rendered_rms, kRms_N, 0.005 * kRms_N);
  EXPECT_LT(result.measured_force.real_rms, 1e-9);
  EXPECT_NEAR(result.high_cycles_per_mm, 4.0, 1e-12);
}

TEST(CheckRenderer, TheSpringsOfTheSceneDoNotMatter) {
  const ProcessResult measured = scan(kTracker, feel_test::wave_m);
  for (const auto& [k_N_per_m, k_c] : {std::pair{100.0, 1.0}, {5000.0, 1.0}, {1000.0, 0.3}}) {
    Scene scene = registered_plate(80.0);
    scene.objects[0].textures[0].texture.stiffness_N_per_m = k_N_per_m;
    scene.objects[0].textures[0].texture.compliance_kc = k_c;
    EXPECT_GT(score(scene, measured).score, 0.97) << k_N_per_m << ' ' << k_c;
  }
}

TEST(CheckRenderer, OtherHeightsAreNoticed) {
  const ProcessResult measured = scan(kTracker, feel_test::wave_m);
  for (const auto& [factor, most] : {std::pair{0.7, 0.45}, {0.5, 0.2}, {2.0, 0.2}, {-1.0, 1e-6}}) {
    const RendererCheck result = score(plate_times(80.0, factor), measured);
    EXPECT_LT(result.score, most) << factor;
    EXPECT_FALSE(result.trustworthy);
    ASSERT_FALSE(result.verdicts.empty());
    EXPECT_EQ(result.verdicts.front().code, "rendering_poor");
    EXPECT_NEAR(result.height.distance_dB, std::abs(20.0 * std::log10(std::abs(factor))), 0.1) << factor;
  }
  const RendererCheck pitch =
      score(registered_plate(80.0), scan(kTracker, [](double x_m) { return feel_test::wave_m(1.9 * x_m); }));
  EXPECT_LT(pitch.score, 0.01);
}

TEST(CheckRenderer, AForceThatHasNoPartAlongTheNormalIsNoticed) {
  const Scene scene = registered_plate(80.0);
  const ProcessResult measured = scan(kTracker, feel_test::wave_m);
  RenderConfig config;
  config.texture.model = TextureForceModel::kLateralGradient;
  const RendererCheck result =
      check_renderer(measured, press_in_scan(measured, scene, 1000.0), make_render_model(scene, config), 1000.0, {});
  EXPECT_GT(result.height_score, 0.97);
  EXPECT_LT(result.score, 0.05);
}

// Holes as of a board: narrow, 0.3 mm deep.
double holes_m(double x_m) {
  return -0.3e-3 * std::pow(0.5 + 0.5 * feel_test::wave_m(x_m) / feel_test::kAmplitude_m, 4);
}

TEST(CheckRenderer, ARepeatingTextureIsJudgedBySpectrumAndDistribution) {
  // The series of the holes over 10 mm, from their samples.
  const auto board = [](double factor) {
    Scene scene = registered_plate(10.0);
    Fourier1d& series = std::get<Fourier1d>(scene.objects[0].textures[0].texture.model);
    constexpr int kSamples = 256, kHarmonics = 32;
    series.a_m.assign(kHarmonics, 0.0);
    series.b_m.assign(kHarmonics, 0.0);
    for (int m = 0; m < kSamples; ++m) {
      for (int j = 1; j <= kHarmonics; ++j) {
        series.a_m[static_cast<std::size_t>(j - 1)] += factor * 2.0 / kSamples * holes_m(10e-3 * m / kSamples) *
                                                       std::cos(2.0 * std::numbers::pi * j * m / kSamples);
      }
    }
    return scene;
  };
  // The scan lies a quarter of the pitch further on: no fault of a texture that repeats.
  const ProcessResult measured = scan(kTracker, [](double x_m) { return holes_m(x_m + 0.625e-3); });
  const RendererCheck faithful = score(board(1.0), measured);
  EXPECT_FALSE(faithful.phase_known);
  EXPECT_THAT(faithful.comparison, ::testing::HasSubstr("the texture repeats after 10.0 mm"));
  EXPECT_GT(faithful.score, 0.85);
  for (const double factor : {0.5, 2.0, -1.0}) EXPECT_LT(score(board(factor), measured).score, 0.45) << factor;
}

TEST(CheckRenderer, APlateWithoutTextureIsCalledSo) {
  Scene scene = registered_plate(80.0);
  scene.objects[0].mesh.haptic.clear();
  scene.objects[0].textures.clear();
  const RendererCheck result = score(scene, scan(kTracker, feel_test::wave_m));
  EXPECT_EQ(result.score, 0.0);
  EXPECT_THAT(result.comparison, ::testing::HasSubstr("no texture"));
}

TEST(CheckRenderer, AScanBesideTheSceneIsRefused) {
  Scene scene = registered_plate(80.0);
  const ProcessResult measured = scan(kTracker, feel_test::wave_m);
  const PressedScan pressed = press_in_scan(measured, scene, 1000.0);
  scene.objects[0].T_world_mesh.translation_m.z() -= 0.01;
  EXPECT_THROW(check_renderer(measured, pressed, make_render_model(scene, {}), 1000.0, {}), Error);
}

}  // namespace
}  // namespace asperity
