#include "asperity/recording/write_recording.h"

#include <gmock/gmock.h>
#include <bit>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "random_recording.h"

namespace asperity {
namespace {

// Same bits, so that -0 differs from 0; any nan equals any other.
bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

template <class Derived>
bool same(const Eigen::MatrixBase<Derived>& a, const Eigen::MatrixBase<Derived>& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return false;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (!same(a.derived().coeff(i % a.rows(), i / a.rows()), b.derived().coeff(i % a.rows(), i / a.rows())))
      return false;
  }
  return true;
}

bool same(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) { return same(a.coeffs(), b.coeffs()); }
bool same(const Pose& a, const Pose& b) {
  return same(a.rotation, b.rotation) && same(a.translation_m, b.translation_m);
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!same(a[i], b[i])) return false;
  }
  return true;
}

template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

void expect_same(const Calibration& a, const Calibration& b) {
  EXPECT_EQ(a.accelerometer.model, b.accelerometer.model);
  EXPECT_TRUE(same(a.accelerometer.B, b.accelerometer.B));
  EXPECT_TRUE(same(a.accelerometer.C, b.accelerometer.C));
  EXPECT_TRUE(same(a.accelerometer.residual_counts, b.accelerometer.residual_counts));
  EXPECT_EQ(a.accelerometer.standard_errors.cols(), b.accelerometer.standard_errors.cols());
  EXPECT_EQ(a.accelerometer.rotation_known, b.accelerometer.rotation_known);
  EXPECT_TRUE(same(a.accelerometer.position_in_marker_m, b.accelerometer.position_in_marker_m));
  EXPECT_EQ(a.accelerometer.position_sigma_m, b.accelerometer.position_sigma_m);
  EXPECT_EQ(a.accelerometer.rotation_sigma_rad, b.accelerometer.rotation_sigma_rad);
  EXPECT_EQ(a.probe_latency_s, b.probe_latency_s);
  EXPECT_EQ(a.probe_latency_sigma_s, b.probe_latency_sigma_s);
  ASSERT_EQ(a.gyroscope.has_value(), b.gyroscope.has_value());
  if (a.gyroscope) {
    EXPECT_TRUE(same(a.gyroscope->B, b.gyroscope->B));
    EXPECT_TRUE(same(a.gyroscope->C, b.gyroscope->C));
  }
  EXPECT_EQ(a.force.newton_per_count, b.force.newton_per_count);
  EXPECT_EQ(a.force.offset_newton, b.force.offset_newton);
  EXPECT_EQ(a.force.residual_newton, b.force.residual_newton);
  EXPECT_TRUE(same(a.force.axis_in_marker, b.force.axis_in_marker));
  EXPECT_TRUE(same(a.tip_in_marker_m, b.tip_in_marker_m));
  EXPECT_EQ(a.tip_radius_m, b.tip_radius_m);
  EXPECT_TRUE(same(a.tracker.sigma_position_m, b.tracker.sigma_position_m));
  EXPECT_TRUE(same(a.tracker.sigma_rotation_rad, b.tracker.sigma_rotation_rad));
  EXPECT_EQ(a.tracker.latency_s, b.tracker.latency_s);
  EXPECT_EQ(a.tracker.latency_sigma_s, b.tracker.latency_sigma_s);
  ASSERT_EQ(a.camera.has_value(), b.camera.has_value());
  if (a.camera) {
    EXPECT_EQ(a.camera->width, b.camera->width);
    EXPECT_EQ(a.camera->height, b.camera->height);
    EXPECT_EQ(a.camera->fx, b.camera->fx);
    EXPECT_EQ(a.camera->cy, b.camera->cy);
    EXPECT_EQ(a.camera->distortion, b.camera->distortion);
    ASSERT_EQ(a.camera->covariance.has_value(), b.camera->covariance.has_value());
    if (a.camera->covariance) {
      EXPECT_TRUE(same(*a.camera->covariance, *b.camera->covariance));
    }
  }
  ASSERT_EQ(a.markers.size(), b.markers.size());
  for (std::size_t i = 0; i < a.markers.size(); ++i) {
    EXPECT_EQ(a.markers[i].id, b.markers[i].id);
    EXPECT_EQ(a.markers[i].family, b.markers[i].family);
    EXPECT_EQ(a.markers[i].size_m, b.markers[i].size_m);
    EXPECT_TRUE(same(a.markers[i].T_marker_tag, b.markers[i].T_marker_tag));
    EXPECT_EQ(a.markers[i].body, b.markers[i].body);
  }
  EXPECT_EQ(a.extra, b.extra);
}

void expect_same(const Recording& a, const Recording& b) {
  EXPECT_EQ(a.info.created, b.info.created);
  EXPECT_EQ(a.info.object, b.info.object);
  EXPECT_EQ(a.info.world, b.info.world);
  EXPECT_EQ(a.info.probe_model, b.info.probe_model);
  EXPECT_EQ(a.info.probe_rate_Hz, b.info.probe_rate_Hz);
  EXPECT_EQ(a.info.adc_min, b.info.adc_min);
  EXPECT_EQ(a.info.adc_max, b.info.adc_max);
  EXPECT_EQ(a.info.tracker_rate_Hz, b.info.tracker_rate_Hz);
  EXPECT_TRUE(same(a.info.gravity_world_mps2, b.info.gravity_world_mps2));
  ASSERT_EQ(a.info.segments.size(), b.info.segments.size());
  for (std::size_t i = 0; i < a.info.segments.size(); ++i) {
    EXPECT_EQ(a.info.segments[i].name, b.info.segments[i].name);
    EXPECT_EQ(a.info.segments[i].start_ns, b.info.segments[i].start_ns);
    EXPECT_EQ(a.info.segments[i].end_ns, b.info.segments[i].end_ns);
  }
  EXPECT_EQ(a.info.problems, b.info.problems);
  EXPECT_EQ(a.info.extra, b.info.extra);
  expect_same(a.calibration, b.calibration);
  EXPECT_EQ(a.probe.t_ns, b.probe.t_ns);
  EXPECT_TRUE(same(a.probe.accel_counts, b.probe.accel_counts));
  EXPECT_TRUE(same(a.probe.force_counts, b.probe.force_counts));
  EXPECT_TRUE(same(a.probe.gyro_counts, b.probe.gyro_counts));
  EXPECT_TRUE(same(a.probe.force3_counts, b.probe.force3_counts));
  EXPECT_EQ(a.tracker.t_ns, b.tracker.t_ns);
  EXPECT_TRUE(same(a.tracker.T_world_marker, b.tracker.T_world_marker));
  EXPECT_EQ(a.tracker.markers, b.tracker.markers);
  EXPECT_TRUE(same(a.tracker.reprojection_px, b.tracker.reprojection_px));
  EXPECT_TRUE(same(a.tracker.sigma_position_m, b.tracker.sigma_position_m));
  EXPECT_TRUE(same(a.tracker.sigma_rotation_rad, b.tracker.sigma_rotation_rad));
  EXPECT_TRUE(same(a.tracker.noise_position_m, b.tracker.noise_position_m));
  EXPECT_TRUE(same(a.tracker.noise_rotation_rad, b.tracker.noise_rotation_rad));
  ASSERT_EQ(a.info.bodies.size(), b.info.bodies.size());
  ASSERT_EQ(a.body_poses.size(), b.body_poses.size());
  for (std::size_t i = 0; i < a.body_poses.size(); ++i) {
    EXPECT_EQ(a.info.bodies[i].name, b.info.bodies[i].name);
    EXPECT_EQ(a.info.bodies[i].markers, b.info.bodies[i].markers);
    EXPECT_EQ(a.body_poses[i].t_ns, b.body_poses[i].t_ns);
    EXPECT_TRUE(same(a.body_poses[i].T_world_marker, b.body_poses[i].T_world_marker));
  }
  ASSERT_EQ(a.truth.has_value(), b.truth.has_value());
  if (!a.truth) return;
  EXPECT_EQ(a.truth->t_ns, b.truth->t_ns);
  EXPECT_TRUE(same(a.truth->s_m, b.truth->s_m));
  EXPECT_TRUE(same(a.truth->height_m, b.truth->height_m));
  EXPECT_TRUE(same(a.truth->p_world_tip_m, b.truth->p_world_tip_m));
  EXPECT_TRUE(same(a.truth->q_world_marker, b.truth->q_world_marker));
  EXPECT_TRUE(same(a.truth->force_N, b.truth->force_N));
  EXPECT_TRUE(same(a.truth->T_world_object, b.truth->T_world_object));
}

TEST(WriteRecording, ReadsBackExactly) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE(seed);
    const testkit::TempDir dir;
    const Recording written = random_recording(seed);
    write_recording(dir.path(), written);
    const Recording read = read_recording(dir.path());
    EXPECT_TRUE(read.problems.empty());
    expect_same(written, read);
    // What was read writes the same bytes again.
    EXPECT_EQ(format_calibration(read.calibration), read_file(dir / "calibration.json", 1 << 20));
    EXPECT_EQ(format_recording_info(read.info), read_file(dir / "recording.json", 1 << 20));
    EXPECT_EQ(format_probe_csv(read.probe), read_file(dir / "probe.csv", 1 << 20));
    EXPECT_EQ(format_tracker_csv(read.tracker), read_file(dir / "tracker.csv", 1 << 20));
    EXPECT_TRUE(is_recording_folder(dir.path()));
  }
}

// As values they have the numbers of the file, whole ones without a point.
TEST(WriteRecording, CameraAndMarkersAloneAreThoseOfTheFile) {
  int cameras = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    const Calibration calibration = random_recording(seed).calibration;
    const Json file = parse_json(format_calibration(calibration));
    if (!calibration.camera || calibration.markers.empty()) continue;
    EXPECT_EQ(camera_json(*calibration.camera).dump(), file.at("camera").dump());
    EXPECT_EQ(markers_json(calibration.markers).dump(), file.at("markers").dump());
    ++cameras;
  }
  EXPECT_GT(cameras, 0);
}

TEST(WriteRecording, WholeNumbersStayWhole) {
  ProbeStream probe;
  probe.t_ns = {1'000'000'000};
  probe.accel_counts = {{100000.0, -32768.0, 1e15}};
  probe.force_counts = {std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(format_probe_csv(probe),
            "t_ns,accel_i,accel_j,accel_k,force\n1000000000,100000,-32768,1000000000000000,\n");
}

TEST(WriteRecording, RefusesWhatCouldNotBeRead) {
  const testkit::TempDir dir;
  Recording recording = random_recording(1);
  recording.probe.t_ns.back() = recording.probe.t_ns.front();
  EXPECT_THAT([&] { write_recording(dir.path(), recording); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("does not rise")));
  recording = random_recording(1);
  recording.calibration.force.offset_newton = std::numeric_limits<double>::infinity();
  EXPECT_THAT([&] { write_recording(dir.path(), recording); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("offset_newton: inf")));
  recording = random_recording(1);
  recording.info.extra = Json::array({1});
  EXPECT_THROW(write_recording(dir.path(), recording), Error);
  EXPECT_FALSE(is_recording_folder(dir.path()));
}

}  // namespace
}  // namespace asperity
