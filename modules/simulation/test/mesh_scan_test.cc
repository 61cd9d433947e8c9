#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/mesh_stroke.h"
#include "asperity/simulation/simulate_recording.h"
#include "mesh_truth.h"
#include "meshes.h"

namespace asperity {
namespace {

SimulationConfig on_mesh(const char* surface, double length_m = 0.02) {
  SimulationConfig config = make_simulation_config(surface, "open");
  config.shape.kind = BaseShapeKind::kMesh;
  config.hand.length_m = length_m;
  config.hand.rest_s = 0.2;
  return config;
}

SimulationConfig bare(double length_m) {
  SimulationConfig config = on_mesh("sine", length_m);
  config.surface.amplitude_m = 0.0;
  return config;
}

Recording simulate(const SimulationConfig& config, const TriangleMesh& mesh) {
  return simulate_recording(config, *make_surface(config.surface, static_cast<std::uint64_t>(config.seed)), mesh);
}

double stated_length_m(const Recording& recording) { return recording.info.simulation.value().path_length_m.value(); }

struct BruteFoot {
  double height_m = 0.0;
  bool found = false;
};

// p = b + h n(b) over all triangles, n interpolated between the vertices' angle-weighted normals: the ray from p
// against the normal met so far is cast on every triangle, until the normal stays.
BruteFoot brute_foot(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& normals, const Eigen::Vector3d& p,
                     Eigen::Vector3d normal) {
  BruteFoot out;
  for (int round = 0; round < 30; ++round) {
    out.found = false;
    Eigen::Vector3d next = normal;
    for (const Triangle& t : mesh.triangles) {
      const Eigen::Vector3d &a = mesh.vertices_m[t[0]], e1 = mesh.vertices_m[t[1]] - a, e2 = mesh.vertices_m[t[2]] - a;
      const Eigen::Vector3d q = normal.cross(e2);
      const double determinant = e1.dot(q);
      if (determinant == 0.0) continue;
      const Eigen::Vector3d from = p - a, r = from.cross(e1);
      const double u = from.dot(q) / determinant, v = normal.dot(r) / determinant, h = -e2.dot(r) / determinant;
      if (u < -1e-9 || v < -1e-9 || u + v > 1.0 + 1e-9 || e1.cross(e2).dot(normal) <= 0.0) continue;
      if (out.found && std::abs(h) >= std::abs(out.height_m)) continue;
      out = {h, true};
      next = ((1.0 - u - v) * normals[t[0]] + u * normals[t[1]] + v * normals[t[2]]).normalized();
    }
    const bool settled = (next - normal).norm() < 1e-13;
    normal = next;
    if (settled) break;
  }
  return out;
}

// One copy of vertices at the same place, angle-weighted normals.
std::vector<Eigen::Vector3d> brute_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> out(mesh.vertices_m.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d& a = mesh.vertices_m[t[k]];
        if ((a - mesh.vertices_m[i]).norm() > 1e-12) continue;
        const Eigen::Vector3d u = mesh.vertices_m[t[(k + 1) % 3]] - a, v = mesh.vertices_m[t[(k + 2) % 3]] - a;
        out[i] += std::atan2(u.cross(v).norm(), u.dot(v)) * u.cross(v).normalized();
      }
    }
    out[i].normalize();
  }
  return out;
}

TEST(MeshScan, TruthIsTheHeightAlongTheMeshsInterpolatedNormal) {
  const TriangleMesh mesh = bumpy_mesh(24);  // edges of 3 mm
  const std::vector<Eigen::Vector3d> normals = brute_normals(mesh);
  for (const char* surface : {"sandpaper", "protoboard"}) {
    const Recording recording = simulate(on_mesh(surface, 0.05), mesh);
    const Truth& truth = *recording.truth;
    const Pose T_mesh_world = recording.info.T_mesh_world.value();
    double worst_m = 0.0;
    for (std::size_t i = 0; i < truth.size(); i += 97) {
      const Eigen::Vector3d p = T_mesh_world * truth.p_world_tip_m[i];
      const BruteFoot foot = brute_foot(mesh, normals, p, p.normalized());
      ASSERT_TRUE(foot.found);
      worst_m = std::max(worst_m, std::abs(foot.height_m - truth.height_m[i]));
    }
    EXPECT_LT(worst_m, 1e-12) << surface;  // rounding of 0.35 m
  }
}

TEST(MeshScan, TipRollsOverTheFacetsThemselves) {
  const TriangleMesh mesh = bumpy_mesh(24);
  const SimulationConfig config = bare(0.06);
  const Recording recording = simulate(config, mesh);
  const Truth& truth = *recording.truth;
  double mean_m = 0.0, square_m2 = 0.0, largest_mps2 = 0.0;
  const auto n = static_cast<double>(truth.size());
  for (const double h : truth.height_m) mean_m += h / n;
  for (const double h : truth.height_m) square_m2 += (h - mean_m) * (h - mean_m) / n;
  for (std::size_t i = 1; i + 1 < truth.size(); ++i) {
    const Eigen::Vector3d twice =
        truth.p_world_tip_m[i + 1] - 2.0 * truth.p_world_tip_m[i] + truth.p_world_tip_m[i - 1];
    largest_mps2 = std::max(largest_mps2, twice.norm() * 4000.0 * 4000.0);
  }
  EXPECT_NEAR(mean_m, -4e-6, 1e-6);         // pressed in by 0.8 N on 200 N/mm
  EXPECT_LT(std::sqrt(square_m2), 1.5e-6);  // the force's variation and the bounce at the edges
  EXPECT_LT(largest_mps2, 30.0);            // bends of some degrees at 25 mm/s: 2 mm/s in 1/4 period of 2.8 ms
}

TEST(MeshScan, FlatPlateGivesWhatAPlaneGives) {
  SimulationConfig config = on_mesh("sandpaper");
  const Recording plate = simulate(config, plate_mesh(0.1, 0.03, 16));
  config.shape.kind = BaseShapeKind::kPlane;
  const Recording plane = simulate_recording(config, *make_surface(config.surface, 1));
  ASSERT_EQ(plate.truth->size(), plane.truth->size());
  for (std::size_t i = 0; i < plane.truth->size(); i += 11) {
    EXPECT_NEAR((plate.truth->p_world_tip_m[i] - plane.truth->p_world_tip_m[i]).norm(), 0.0, 1e-9);
    EXPECT_NEAR(plate.truth->height_m[i], plane.truth->height_m[i], 1e-9);
    EXPECT_NEAR(plate.truth->s_m[i], plane.truth->s_m[i], 1e-7);  // chords of 25 µm of the wander
    EXPECT_LT(plate.truth->q_world_marker[i].angularDistance(plane.truth->q_world_marker[i]), 1e-7);
  }
}

TEST(MeshScan, ReliefLiesAlongThePath) {
  SimulationConfig config = on_mesh("sine", 0.06);
  config.surface.amplitude_m = 20e-6;
  config.hand.force_variation = 0.0;
  const Recording recording = simulate(config, sphere_mesh(0.04, 40));
  const Truth& truth = *recording.truth;
  double worst_m = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double relief_m = 20e-6 * std::sin(2.0 * M_PI * (truth.s_m[i] - 0.03) / 2e-3);
    worst_m = std::max(worst_m, std::abs(truth.height_m[i] + 4e-6 - relief_m));
  }
  // The base's length differs from the mesh's by (1 mm / 40 mm)²/2 = 0.03 % and by the facets: 15 µm of 30 mm shift
  // the sine by 1 µm; the sphere of the tip and the bounce at edges do the rest.
  EXPECT_LT(worst_m, 4e-6);
  EXPECT_NEAR(stated_length_m(recording), 0.06, 0.1e-3);
  EXPECT_NEAR(truth.s_m.back() - truth.s_m.front(), 0.06, 0.3e-3);
}

TEST(MeshScan, AccelerometerIsTheSecondDerivativeOfItsPosition) {
  SimulationConfig config = on_mesh("sandpaper");
  SimulatedProbeConfig& probe = config.probe;
  probe.true_rate_Hz = 40000.0;
  probe.quantise = false;
  probe.accel_noise_mps2_per_rtHz = probe.gyro_noise_radps_per_rtHz = probe.force_noise_N = 0.0;
  probe.accel_bandwidth_Hz = probe.gyro_bandwidth_Hz = probe.force_bandwidth_Hz = probe.clock_jitter_s = 0.0;
  config.calibration.imperfection = 0.0;
  const Recording recording = simulate(config, bumpy_mesh(24));
  const Truth& truth = *recording.truth;
  const Calibration& c = recording.calibration;
  const Eigen::Vector3d lever = *c.accelerometer.position_in_marker_m - c.tip_in_marker_m;
  const Eigen::Matrix3d inverse = Eigen::Matrix3d(c.accelerometer.B).inverse();
  const auto sensor = [&](std::size_t i) {
    return Eigen::Vector3d(truth.p_world_tip_m[i] + truth.q_world_marker[i] * lever);
  };
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 1; i + 1 < truth.size(); ++i) {
    const Eigen::Vector3d a = (sensor(i + 1) - 2.0 * sensor(i) + sensor(i - 1)) / (config.step_s * config.step_s);
    const Eigen::Vector3d read =
        truth.q_world_marker[i] * (inverse * (recording.probe.accel_counts[i] - c.accelerometer.C)) +
        recording.info.gravity_world_mps2;
    worst = std::max(worst, (a - read).norm());
    largest = std::max(largest, a.norm());
  }
  EXPECT_LT(worst, 1e-4);  // positions of 0.3 m to 1e-16 differenced twice over 25 µs
  EXPECT_LT(largest, 200.0);
}

TEST(MeshScan, GivenPoseIsTheMeshsPose) {
  SimulationConfig config = on_mesh("sandpaper");
  config.shape.mesh_pose = MeshPose::kGiven;
  config.shape.mesh_position_m = {0.1, -0.05, 0.4};
  config.shape.mesh_rotation_rad = {1.0, -2.0, 0.5};
  config.shape.through = "0,0,0.045";
  const TriangleMesh mesh = bumpy_mesh(16);
  const Recording recording = simulate(config, mesh);
  const Pose expected = Pose{exp_rotation(Eigen::Vector3d(1.0, -2.0, 0.5)), Eigen::Vector3d(0.1, -0.05, 0.4)}.inverse();
  const Pose stated = recording.info.T_mesh_world.value();
  EXPECT_LT(stated.rotation.angularDistance(expected.rotation), 1e-12);
  EXPECT_LT((stated.translation_m - expected.translation_m).norm(), 1e-12);
  for (std::size_t i = 0; i < recording.truth->size(); i += 500) {
    const Eigen::Vector3d p = expected * recording.truth->p_world_tip_m[i];
    EXPECT_LT((p - Eigen::Vector3d(0, 0, 0.045)).norm(), 0.02);
    // The probe stands outside (erratum 24).
    const Eigen::Vector3d axis =
        expected.rotation * (recording.truth->q_world_marker[i] * -recording.calibration.tip_in_marker_m);
    EXPECT_GT(axis.dot(p), 0.0);
  }
}

TEST(MeshScan, PathGoesThroughPickedPointsTheShortestWay) {
  const double radius_m = 0.04;
  const MeshSurface surface(sphere_mesh(radius_m, 40));
  const std::vector<Eigen::Vector3d> picked{{0.04, 0, 0}, {0, 0.04, 0.0}, {0.0, 0.02, 0.03464}};
  const MeshStroke stroke = trace_mesh_stroke(surface, picked, 0.0);
  // Great circles of 90° and 60°; facets of 1.6 mm lie up to 8 µm below the sphere.
  EXPECT_NEAR(stroke.length_m, radius_m * M_PI * (1.0 / 2.0 + 1.0 / 3.0), 0.1e-3);
  for (const Eigen::Vector3d& point : picked) {
    double nearest_m = 1.0;
    for (const Eigen::Vector3d& p : stroke.p_mesh_m) nearest_m = std::min(nearest_m, (p - point).norm());
    EXPECT_LT(nearest_m, 0.1e-3);
  }
  double off_m = 0.0, aside_m = 0.0;
  for (std::size_t i = 0; i < stroke.p_mesh_m.size(); ++i) {
    off_m = std::max(off_m, surface.bvh.closest_point(stroke.p_mesh_m[i]).distance_m);
    const double a_m = static_cast<double>(i) * stroke.spacing_m - stroke.margin_m;
    if (a_m > 0.0 && a_m < 0.06) aside_m = std::max(aside_m, std::abs(stroke.p_mesh_m[i].z()));
  }
  EXPECT_LT(aside_m, 0.4e-3);  // from the first leg's plane: a shortest line on facets is not one on the sphere
  EXPECT_LT(off_m, 5e-6);
}

TEST(MeshScan, SharpEdgesAreRolledOver) {
  SimulationConfig config = bare(0.05);
  config.shape.through = "0.005,0,0.02;0.03,0,-0.003";
  const TriangleMesh mesh = rounded_box_mesh({0.03, 0.025, 0.02}, 2e-3, 60);
  const Recording recording = simulate(config, mesh);
  const MeshSurface surface(mesh);
  const Pose T_mesh_world = recording.info.T_mesh_world.value();
  double deepest_m = 0.0, highest_m = 0.0;
  for (std::size_t i = 0; i < recording.truth->size(); ++i) {
    deepest_m = std::min(deepest_m, recording.truth->height_m[i]);
    highest_m = std::max(highest_m, recording.truth->height_m[i]);
    EXPECT_LT(surface.bvh.closest_point(T_mesh_world * recording.truth->p_world_tip_m[i]).distance_m, 1e-3);
  }
  EXPECT_GT(deepest_m, -40e-6);
  EXPECT_LT(highest_m, 1e-3);  // a hand of 40 g flies off an edge taken at 25 mm/s
}

TEST(MeshScan, SameSeedSameData) {
  const SimulationConfig config = on_mesh("sandpaper");
  const TriangleMesh mesh = bumpy_mesh(16);
  const Recording a = simulate(config, mesh);
  const Recording b = simulate(config, mesh);
  EXPECT_EQ(a.probe.accel_counts, b.probe.accel_counts);
  EXPECT_EQ(a.truth->height_m, b.truth->height_m);
  EXPECT_EQ(a.info.simulation.value().settings, b.info.simulation.value().settings);
}

TEST(MeshScan, RefusesWhatCannotBeScanned) {
  const TriangleMesh mesh = sphere_mesh(0.04, 12);
  SimulationConfig config = on_mesh("sine");
  const auto message = [&](const TriangleMesh& on) {
    try {
      simulate(config, on);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  config.shape.through = "40,0,0;0,40,0";
  EXPECT_THAT(message(mesh), ::testing::HasSubstr("are the points in metres"));
  config.shape.through = "0.04,0,0;0.04,0,0";
  EXPECT_THAT(message(mesh), ::testing::HasSubstr("the same"));
  for (const char* bad : {"1,2", "1,2,3,4", "a,b,c", "1,2,nan", "1,2,3;;4,5,6", "1e9,0,0"}) {
    config.shape.through = bad;
    EXPECT_THAT(message(mesh), ::testing::HasSubstr("is not a point")) << bad;
  }
  config.shape.through.clear();
  EXPECT_THAT(message(TriangleMesh{}), ::testing::Not(::testing::IsEmpty()));
  EXPECT_THAT(message(plate_mesh(0.015, 0.01, 4)), ::testing::HasSubstr("leaves the mesh"));
  config.shape.mesh_file.clear();
  EXPECT_THROW(simulate_recording(config), Error);
  EXPECT_THROW(simulate_recording(config, *make_surface(config.surface, 1)), Error);
}

}  // namespace
}  // namespace asperity
