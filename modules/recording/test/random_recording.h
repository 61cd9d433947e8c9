#pragma once

#include <limits>

#include "asperity/base/random.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/recording.h"

namespace asperity {

// Recordings of every shape the format allows, with numbers that are hard to write exactly.
inline double awkward_number(Random& random) {
  switch (random.bits() % 6) {
    case 0:
      return static_cast<double>(static_cast<std::int64_t>(random.uniform(-33000.0, 33000.0)));
    case 1:
      return random.normal() * 1e-7;
    case 2:
      return 1.0 / 3.0 * random.normal();
    case 3:
      return 100000.0;
    case 4:
      return -0.0;
    default:
      return random.uniform(-9999.0, 9999.0);
  }
}

inline Eigen::Vector3d awkward_vector(Random& random) {
  return {awkward_number(random), awkward_number(random), awkward_number(random)};
}

inline Eigen::Quaterniond any_rotation(Random& random) {
  return Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

inline Calibration random_calibration(Random& random) {
  Calibration out;
  const bool quadric = random.chance(0.3);
  out.accelerometer.model = quadric ? AccelerometerModel::kQuadric : AccelerometerModel::kLinear;
  out.accelerometer.B = Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, quadric ? 9 : 3);
  for (Eigen::Index i = 0; i < out.accelerometer.B.size(); ++i) out.accelerometer.B(i) = 0.3 * random.normal();
  out.accelerometer.B.leftCols<3>() += 400.0 * Eigen::Matrix3d::Identity();
  out.accelerometer.C = awkward_vector(random);
  if (random.chance(0.5)) {
    out.accelerometer.standard_errors = Eigen::Matrix<double, 3, Eigen::Dynamic>::Random(3, quadric ? 10 : 4);
  }
  out.accelerometer.residual_counts = awkward_vector(random).cwiseAbs();
  out.accelerometer.rotation_known = random.chance(0.5);
  if (random.chance(0.5)) out.accelerometer.position_in_marker_m = Eigen::Vector3d(0.01, -0.02, random.normal());
  if (random.chance(0.5)) out.accelerometer.position_sigma_m = random.uniform(0.001, 0.1);
  if (random.chance(0.5)) out.accelerometer.rotation_sigma_rad = random.uniform(0.001, 0.1);
  if (random.chance(0.5)) out.probe_latency_s = random.uniform(-0.01, 0.01);
  if (random.chance(0.5)) out.probe_latency_sigma_s = random.uniform(0.001, 0.01);
  if (random.chance(0.5)) {
    out.gyroscope =
        GyroscopeCalibration{Eigen::Matrix3d::Identity() * random.uniform(1.0, 900.0), awkward_vector(random)};
  }
  out.force = {0.025095, -1.313768, 0.196, std::nullopt};
  if (random.chance(0.5)) out.force.axis_in_marker = Eigen::Vector3d(0.1, 0.2, -random.uniform(0.1, 1.0));
  out.tip_in_marker_m = {0.001, random.normal() * 0.01, 0.12};
  out.tracker.latency_s = random.uniform(-0.1, 0.1);
  out.tracker.latency_sigma_s = 0.005;
  if (random.chance(0.5)) {
    out.camera = CameraCalibration{640, 480, 512.1, 512.2, 320.3, 240.4, {0.1, -0.2, 0.0, 1e-5, 0.3}, std::nullopt};
    if (random.chance(0.5)) {
      Eigen::Matrix<double, 9, 9> any;
      for (Eigen::Index i = 0; i < any.size(); ++i) any.data()[i] = random.normal();
      out.camera->covariance = 0.1 * any * any.transpose();
      *out.camera->covariance = (0.5 * (*out.camera->covariance + out.camera->covariance->transpose())).eval();
    }
  }
  for (int i = static_cast<int>(random.bits() % 3); i > 0; --i) {
    out.markers.push_back({i, "tag36h11", 0.03, Pose{any_rotation(random), Eigen::Vector3d(0.01 * i, 0.0, 0.1)}});
  }
  if (random.chance(0.5)) out.extra = parse_json(R"({"a":[1,2.5,{"b":null}],"ü":"µ\"\\"})");
  return out;
}

inline Recording random_recording(std::uint64_t seed) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Random random(seed);
  Recording out;
  out.info.object = random.chance(0.5) ? "a \"clay\" pot, 50 µm\n" : "";
  out.info.world = random.chance(0.5) ? "camera" : "z_up";
  out.info.probe_rate_Hz = 4000.0;
  out.info.adc_min = -32768.0;
  out.info.adc_max = 32767.0;
  out.info.tracker_rate_Hz = 1e9 / 22222222.0;
  out.info.gravity_world_mps2 = {0.01 * random.normal(), 9.8, -0.0};
  if (random.chance(0.5)) out.info.segments = {{"first", -5, 1000}, {"second", 2000, 2000}};
  if (random.chance(0.5)) out.info.problems = {{"lost_packets", 3}, {"bad_crc", 0}};
  out.calibration = random_calibration(random);

  const bool gyro = random.chance(0.5);
  const bool force3 = random.chance(0.3);
  std::int64_t t_ns = static_cast<std::int64_t>(random.uniform(-1e18, 1e18));
  for (std::size_t rows = 1 + random.bits() % 40; rows > 0; --rows) {
    t_ns += 1 + static_cast<std::int64_t>(random.bits() % 1'000'000'000);
    out.probe.t_ns.push_back(t_ns);
    out.probe.accel_counts.push_back(awkward_vector(random));
    out.probe.force_counts.push_back(random.chance(0.5) ? kNan : awkward_number(random));
    if (gyro)
      out.probe.gyro_counts.push_back(random.chance(0.2) ? Eigen::Vector3d::Constant(kNan) : awkward_vector(random));
    if (force3) out.probe.force3_counts.push_back(awkward_vector(random));
  }
  const bool markers = random.chance(0.5);
  const bool reprojection = random.chance(0.5);
  const bool sigmas = random.chance(0.5), noise = random.chance(0.5);
  for (std::size_t rows = 1 + random.bits() % 20; rows > 0; --rows) {
    t_ns += 1 + static_cast<std::int64_t>(random.bits() % 1'000'000'000);
    out.tracker.t_ns.push_back(t_ns);
    out.tracker.T_world_marker.push_back({any_rotation(random), 0.05 * awkward_vector(random)});
    if (markers) out.tracker.markers.push_back(static_cast<int>(random.bits() % 7));
    if (reprojection) out.tracker.reprojection_px.push_back(random.chance(0.2) ? kNan : random.uniform());
    const auto any_sigma = [&]() -> Eigen::Vector3d {
      return Eigen::Vector3d::Constant(random.chance(0.2) ? kNan : random.uniform());
    };
    if (sigmas) {
      out.tracker.sigma_position_m.push_back(any_sigma());
      out.tracker.sigma_rotation_rad.push_back(any_sigma());
    }
    if (noise) {
      out.tracker.noise_position_m.push_back(any_sigma());
      out.tracker.noise_rotation_rad.push_back(any_sigma());
    }
  }
  if (random.chance(0.5)) {
    out.truth.emplace();
    for (std::size_t rows = 1 + random.bits() % 20; rows > 0; --rows) {
      t_ns += 1 + static_cast<std::int64_t>(random.bits() % 1000);
      out.truth->t_ns.push_back(t_ns);
      out.truth->s_m.push_back(random.chance(0.2) ? kNan : random.uniform());
      out.truth->height_m.push_back(random.normal() * 1e-5);
      out.truth->p_world_tip_m.push_back(0.05 * awkward_vector(random));
      out.truth->q_world_marker.push_back(any_rotation(random));
      out.truth->force_N.push_back(random.chance(0.2) ? kNan : random.uniform());
    }
  }
  // A generator of its own: recordings without bodies stay what they were.
  Random other(seed + 1'000'000);
  if (other.chance(0.3)) {
    for (const char* name : {"object", "table-2"}) {
      out.info.bodies.push_back({name, {7, 8}});
      TrackerStream& poses = out.body_poses.emplace_back();
      for (std::size_t rows = 1 + other.bits() % 8; rows > 0; --rows) {
        poses.t_ns.push_back((poses.t_ns.empty() ? 0 : poses.t_ns.back()) + 1 +
                             static_cast<std::int64_t>(other.bits() % 1'000'000'000));
        poses.T_world_marker.push_back({any_rotation(other), 0.05 * awkward_vector(other)});
      }
    }
    if (!out.calibration.markers.empty()) out.calibration.markers.back().body = "object";
    if (out.truth) {
      for (std::size_t i = 0; i < out.truth->size(); ++i)
        out.truth->T_world_object.push_back({any_rotation(other), 0.05 * awkward_vector(other)});
    }
  }
  return out;
}

}  // namespace asperity
