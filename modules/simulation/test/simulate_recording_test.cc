#include "asperity/simulation/simulate_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"
#include "asperity/simulation/probe_truth.h"

namespace asperity {
namespace {

SimulationConfig short_config(const char* surface, const char* probe) {
  SimulationConfig config = make_simulation_config(surface, probe);
  config.hand.length_m = 0.015;
  config.hand.rest_s = 0.2;
  return config;
}

// Sensors without noise, rounding, delay or error of calibration, sampled at `rate_Hz`.
SimulationConfig exact(const char* surface, double rate_Hz) {
  SimulationConfig config = short_config(surface, "open");
  SimulatedProbeConfig& probe = config.probe;
  probe.true_rate_Hz = rate_Hz;
  probe.quantise = false;
  probe.accel_noise_mps2_per_rtHz = probe.gyro_noise_radps_per_rtHz = probe.force_noise_N = 0.0;
  probe.accel_bandwidth_Hz = probe.gyro_bandwidth_Hz = probe.force_bandwidth_Hz = 0.0;
  probe.clock_jitter_s = 0.0;
  config.calibration.imperfection = 0.0;
  return config;
}

struct Exact {
  std::vector<Eigen::Vector3d> specific_force_mps2, omega_radps, a_world_mps2;
};

Exact decode(const Recording& recording) {
  Exact out;
  const Calibration& c = recording.calibration;
  const Eigen::Matrix3d accel = Eigen::Matrix3d(c.accelerometer.B).inverse();
  const Eigen::Matrix3d gyro = c.gyroscope->B.inverse();
  for (std::size_t i = 0; i < recording.probe.size(); ++i) {
    out.specific_force_mps2.push_back(accel * (recording.probe.accel_counts[i] - c.accelerometer.C));
    out.omega_radps.push_back(gyro * (recording.probe.gyro_counts[i] - c.gyroscope->C));
    out.a_world_mps2.push_back(recording.truth->q_world_marker[i] * out.specific_force_mps2.back() +
                               recording.info.gravity_world_mps2);
  }
  return out;
}

TEST(SimulateRecording, AccelerometerIsTheSecondDerivativeOfItsPosition) {
  for (const char* surface : {"sine", "protoboard", "clay_pot"}) {
    const SimulationConfig config = exact(surface, 40000.0);
    const Recording recording = simulate_recording(config);
    const Truth& truth = *recording.truth;
    const Exact read = decode(recording);
    const Eigen::Vector3d lever =
        *recording.calibration.accelerometer.position_in_marker_m - recording.calibration.tip_in_marker_m;
    const auto sensor = [&](std::size_t i) {
      return Eigen::Vector3d(truth.p_world_tip_m[i] + truth.q_world_marker[i] * lever);
    };
    double worst = 0.0;
    for (std::size_t i = 1; i + 1 < truth.size(); ++i) {
      const Eigen::Vector3d a = (sensor(i + 1) - 2.0 * sensor(i) + sensor(i - 1)) / (config.step_s * config.step_s);
      worst = std::max(worst, (a - read.a_world_mps2[i]).norm());
    }
    // Positions of 0.3 m to 1e-16 differenced twice over 25 µs; up to 500 m/s² at the protoboard's edges.
    EXPECT_LT(worst, 1e-4) << surface;
  }
}

TEST(SimulateRecording, LeverArmTermsAreThoseOfARigidBody) {
  SimulationConfig config = exact("sine", 4000.0);
  config.hand.tremor_rotation_rad = 5e-3;
  const Recording at_sensor = simulate_recording(config);
  config.probe.sensor_in_marker_m = config.probe.tip_in_marker_m;
  const Recording at_tip = simulate_recording(config);
  const Exact sensor = decode(at_sensor);
  const Exact tip = decode(at_tip);
  const Eigen::Vector3d lever =
      *at_sensor.calibration.accelerometer.position_in_marker_m - at_sensor.calibration.tip_in_marker_m;
  double worst = 0.0;
  double largest = 0.0;
  for (std::size_t i = 2; i + 2 < sensor.omega_radps.size(); ++i) {
    const auto& w = sensor.omega_radps;
    const Eigen::Vector3d alpha = (8.0 * (w[i + 1] - w[i - 1]) - (w[i + 2] - w[i - 2])) * 4000.0 / 12.0;
    const Eigen::Vector3d turning = alpha.cross(lever) + w[i].cross(w[i].cross(lever));
    worst = std::max(worst, (sensor.specific_force_mps2[i] - tip.specific_force_mps2[i] - turning).norm());
    largest = std::max(largest, turning.norm());
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(worst, 1e-4);
}

TEST(SimulateRecording, AccelerationIntegratesTwiceToTheTruth) {
  const Recording recording = simulate_recording(exact("sine", 40000.0));
  const Truth& truth = *recording.truth;
  const Exact read = decode(recording);
  const Eigen::Vector3d lever =
      *recording.calibration.accelerometer.position_in_marker_m - recording.calibration.tip_in_marker_m;
  const double step_s = 1.0 / 40000.0;
  Eigen::Vector3d p = truth.p_world_tip_m[0] + truth.q_world_marker[0] * lever;
  Eigen::Vector3d v = (truth.p_world_tip_m[1] + truth.q_world_marker[1] * lever - p) / step_s -
                      (2.0 * read.a_world_mps2[0] + read.a_world_mps2[1]) * step_s / 6.0;
  double worst_m = 0.0;
  for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
    const Eigen::Vector3d& a = read.a_world_mps2[i];
    const Eigen::Vector3d& b = read.a_world_mps2[i + 1];
    p += v * step_s + (2.0 * a + b) * step_s * step_s / 6.0;  // a linear between samples
    v += 0.5 * (a + b) * step_s;
    worst_m = std::max(worst_m, (p - truth.p_world_tip_m[i + 1] - truth.q_world_marker[i + 1] * lever).norm());
  }
  EXPECT_LT(worst_m, 5e-6);  // over 1.25 s and 15 mm
}

TEST(SimulateRecording, AtRestTheAccelerometerReadsMinusGravity) {
  SimulationConfig config = exact("sine", 4000.0);
  config.surface.amplitude_m = 0.0;
  config.hand.tremor_lateral_m = config.hand.tremor_normal_m = config.hand.tremor_along_m = 0.0;
  config.hand.tremor_rotation_rad = config.hand.tilt_wander_rad = config.hand.force_variation = 0.0;
  const Recording recording = simulate_recording(config);
  const Exact read = decode(recording);
  for (std::size_t i = 100; i < 400; ++i) {
    const Eigen::Vector3d up = recording.truth->q_world_marker[i] * read.specific_force_mps2[i];
    EXPECT_NEAR((up - Eigen::Vector3d(0.0, -9.80665, 0.0)).norm(), 0.0, 1e-6);
  }
}

TEST(SimulateRecording, SameSeedSameDataOtherSeedOtherData) {
  for (const char* probe : {"open", "what"}) {
    SimulationConfig config = short_config("sandpaper", probe);
    const Recording a = simulate_recording(config);
    const Recording b = simulate_recording(config);
    EXPECT_EQ(a.probe.t_ns, b.probe.t_ns);
    EXPECT_EQ(a.probe.accel_counts, b.probe.accel_counts);
    EXPECT_EQ(a.tracker.t_ns, b.tracker.t_ns);
    EXPECT_EQ(a.truth->height_m, b.truth->height_m);
    EXPECT_EQ(a.calibration.accelerometer.B, b.calibration.accelerometer.B);
    EXPECT_EQ(a.info.simulation.value().settings, b.info.simulation.value().settings);
    config.seed = 2;
    const Recording c = simulate_recording(config);
    EXPECT_NE(a.probe.accel_counts, c.probe.accel_counts);
    EXPECT_NE(a.truth->height_m, c.truth->height_m);
  }
}

TEST(SimulateRecording, SensorNoiseLeavesTheMotionAlone) {
  SimulationConfig config = short_config("sandpaper", "open");
  const Recording a = simulate_recording(config);
  config.probe.accel_noise_mps2_per_rtHz *= 3.0;
  config.tracker.rate_Hz = 45.0;
  const Recording b = simulate_recording(config);
  EXPECT_EQ(a.truth->height_m, b.truth->height_m);
  EXPECT_EQ(a.probe.gyro_counts, b.probe.gyro_counts);
}

TEST(SimulateRecording, OpenProbeIsSampledAsItClaims) {
  const Recording recording = simulate_recording(short_config("protoboard", "open"));
  const ProbeStream& probe = recording.probe;
  ASSERT_EQ(probe.size(), recording.truth->size());
  const double seconds = static_cast<double>(probe.t_ns.back() - probe.t_ns.front()) * 1e-9;
  EXPECT_NEAR(static_cast<double>(probe.size() - 1) / seconds, 4000.0, 1.0);
  std::size_t forces = 0;
  for (std::size_t i = 0; i < probe.size(); ++i) {
    forces += !std::isnan(probe.force_counts[i]);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(probe.accel_counts[i][axis], std::round(probe.accel_counts[i][axis]));
      EXPECT_LE(std::abs(probe.accel_counts[i][axis]), 32768.0);
    }
    EXPECT_NEAR(static_cast<double>(probe.t_ns[i] - recording.truth->t_ns[i]), 0.0, 0.12e6);  // 6 σ of 20 µs
    if (i > 0) {
      EXPECT_GT(probe.t_ns[i], probe.t_ns[i - 1]);
    }
  }
  EXPECT_NEAR(static_cast<double>(forces) / seconds, 320.0, 2.0);
}

TEST(SimulateRecording, WhatIsCoarseLossyAndSpiky) {
  SimulationConfig config = make_simulation_config("protoboard", "what");
  config.hand.path = HandPathShape::kBackAndForth;
  const Recording recording = simulate_recording(config);
  const ProbeStream& probe = recording.probe;
  EXPECT_EQ(recording.info.probe_rate_Hz, 500.0);
  EXPECT_FALSE(probe.has_gyro());
  const double samples = static_cast<double>(recording.truth->size());
  const double seconds = static_cast<double>(recording.truth->t_ns.back() - recording.truth->t_ns.front()) * 1e-9;
  EXPECT_NEAR((samples - 1.0) / seconds, 400.0, 0.5);
  EXPECT_NEAR(1.0 - static_cast<double>(probe.size()) / samples, 0.016, 0.016);
  EXPECT_LT(static_cast<double>(probe.size()), samples);
  bool saturated = false;
  for (std::size_t i = 0; i < probe.size(); ++i) {
    EXPECT_EQ(probe.t_ns[i] % 1'000'000, 0);
    if (i > 0) {
      EXPECT_GT(probe.t_ns[i], probe.t_ns[i - 1]);
    }
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double count = probe.accel_counts[i][axis];
      EXPECT_EQ(count, std::round(count));
      EXPECT_GE(count, 0.0);
      EXPECT_LE(count, 255.0);
      saturated = saturated || count == 255.0 || count == 0.0;
    }
  }
  EXPECT_TRUE(saturated);
}

TEST(SimulateRecording, ForceReadingIsTheContactAlongTheProbe) {
  SimulationConfig config = exact("sine", 4000.0);
  config.surface.amplitude_m = 0.0;
  config.hand.tremor_normal_m = config.hand.force_variation = 0.0;
  const Recording recording = simulate_recording(config);
  const Calibration& c = recording.calibration;
  const Eigen::Vector3d axis = -c.tip_in_marker_m.normalized();
  const Eigen::Vector3d normal = Eigen::Vector3d(0.0, -0.9397, -0.3420).normalized();
  const double force_N = c.force.newton_per_count * recording.probe.force_counts[0] + c.force.offset_newton;
  EXPECT_NEAR(recording.truth->force_N[0], 0.8, 1e-6);
  // At rest the hand's tremor along the path strains the bristles: a tangential force of some mN.
  EXPECT_NEAR(force_N, 0.8 * normal.dot(recording.truth->q_world_marker[0] * axis), 0.05);
}

TEST(SimulateRecording, TruthIsConsistentWithTheBaseShape) {
  for (const char* surface : {"sandpaper", "clay_pot"}) {
    SimulationConfig config = short_config(surface, "open");
    const Recording recording = simulate_recording(config);
    const Truth& truth = *recording.truth;
    const Eigen::Vector3d normal = Eigen::Vector3d(config.shape.normal.data()).normalized();
    const Eigen::Vector3d centre(config.shape.centre_m.data());
    const Eigen::Vector3d across = normal.cross(Eigen::Vector3d::UnitX());
    double worst_m = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Eigen::Vector3d p = truth.p_world_tip_m[i] - centre;
      const Eigen::Vector3d from_axis = p + 0.06 * normal;
      const double height_m = config.shape.kind == BaseShapeKind::kPlane
                                  ? p.dot(normal)
                                  : (from_axis - across * across.dot(from_axis)).norm() - 0.06;
      worst_m = std::max(worst_m, std::abs(height_m - truth.height_m[i]));
      EXPECT_GT((truth.q_world_marker[i] * -recording.calibration.tip_in_marker_m).dot(normal), 0.0);  // erratum 24
    }
    EXPECT_LT(worst_m, 1e-8) << surface;
    EXPECT_NEAR(truth.s_m.back() - truth.s_m.front(), 0.015, 0.3e-3);
  }
}

TEST(SimulateRecording, StatedCalibrationIsWrongByItsStatedErrors) {
  const SimulationConfig config;
  const Eigen::Vector3d sigma_m(1e-4, 1e-4, 5e-4);
  const Eigen::Vector3d sigma_rad(4e-3, 4e-3, 2e-3);
  double sum = 0.0;
  double latency = 0.0;
  constexpr int kSeeds = 400;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Calibration truth = make_probe_truth(config.probe, config.tracker, seed);
    const Calibration stated =
        make_stated_calibration(truth, config.probe, config.calibration, sigma_m, sigma_rad, seed);
    ASSERT_EQ(stated.accelerometer.standard_errors.cols(), 4);
    for (Eigen::Index r = 0; r < 3; ++r) {
      const auto error = [&](double a, double b, Eigen::Index c) {
        return std::pow((a - b) / stated.accelerometer.standard_errors(r, c), 2);
      };
      for (Eigen::Index c = 0; c < 3; ++c)
        sum += error(stated.accelerometer.B(r, c), truth.accelerometer.B(r, c), c) / 12;
      sum += error(stated.accelerometer.C[r], truth.accelerometer.C[r], 3) / 12;
    }
    latency += std::pow((stated.tracker.latency_s - config.tracker.latency_s) / stated.tracker.latency_sigma_s, 2);
  }
  EXPECT_NEAR(sum / kSeeds, 1.0, 0.08);      // χ² of 4800, 4 σ
  EXPECT_NEAR(latency / kSeeds, 1.0, 0.29);  // χ² of 400, 4 σ
}

TEST(SimulateRecording, SegmentsAndConfigAreRecorded) {
  const Recording recording = simulate_recording(short_config("cable_tie", "open"));
  ASSERT_EQ(recording.info.segments.size(), 3u);
  EXPECT_EQ(recording.info.segments[0].name, "rest");
  EXPECT_EQ(recording.info.segments[1].start_ns, recording.info.segments[0].end_ns);
  EXPECT_NEAR(static_cast<double>(recording.info.segments[0].end_ns) * 1e-9, 1.2, 1e-9);
  EXPECT_EQ(recording.info.object, "cable_tie");
  EXPECT_EQ(recording.info.simulation.value().settings.at("surface.kind"), "cable_tie");
}

TEST(SimulateRecording, RefusesWhatItCannotIntegrateAndStopsWhenAsked) {
  SimulationConfig config = short_config("sine", "open");
  config.contact.stiffness_N_per_m = 5e6;
  config.step_s = 100e-6;
  EXPECT_THROW(simulate_recording(config), Error);
  Observer observer;
  observer.cancelled = [] { return true; };
  EXPECT_THROW(simulate_recording(short_config("sine", "open"), observer), Cancelled);
}

TEST(SimulationConfig, FieldsAreSetByTheirPaths) {
  SimulationConfig config = make_simulation_config("protoboard", "what");
  const auto fields = list_fields("simulation", config);
  set_field(fields, "simulation.hand.speed_mps", "0.045");
  set_field(fields, "simulation.shape.kind", "cylinder");
  EXPECT_EQ(config.hand.speed_mps, 0.045);
  EXPECT_EQ(config.shape.kind, BaseShapeKind::kCylinder);
  std::set<std::string> paths;
  for (const ConfigField& field : fields) EXPECT_TRUE(paths.insert(field.path).second) << field.path;
}

}  // namespace
}  // namespace asperity
