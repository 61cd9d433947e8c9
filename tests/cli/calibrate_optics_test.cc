// `asperity calibrate camera|tracker|imu|latency` on the bench's images and recordings.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "asperity/base/random.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/simulation/board_poses.h"
#include "asperity/simulation/calibration_motion.h"
#include "asperity/simulation/render_board.h"
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

// Images of the bench's checkerboard of 9x6 corners, 25 mm.
void render_boards(const fs::path& folder, int count) {
  fs::create_directory(folder);
  const SimulatedCameraConfig config;
  const SimulatedBoard board;
  BoardRenderer renderer(config, board);
  GrayImage image;
  std::uint64_t frame = 0;
  for (const Pose& T_world_board : board_poses(config, board, count, 1)) {
    renderer.render(T_world_board, frame, image);
    std::string bytes = "P5 " + std::to_string(image.width) + " " + std::to_string(image.height) + " 255\n";
    bytes.append(image.pixels.begin(), image.pixels.end());
    write_text(folder / ("board" + std::to_string(10 + frame++) + ".pgm"), bytes);
  }
}

// A body at rest before the camera, seen 45 times a second with noise that is white.
Recording at_rest(double duration_s, const Eigen::Vector3d& sigma_position_m, double sigma_rotation_rad) {
  Recording out;
  out.info.world = "camera";
  out.calibration.accelerometer.B = Eigen::Matrix3d::Identity();
  out.calibration.force.axis_in_marker = Eigen::Vector3d::UnitZ();
  Random random(7);
  const auto noise = [&random] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()); };
  for (int i = 0; i < static_cast<int>(45.0 * duration_s); ++i) {
    const auto t_ns = static_cast<std::int64_t>(1e9 + 1e9 * i / 45.0);
    const Pose pose{exp_rotation(sigma_rotation_rad * noise()) * exp_rotation({0.2, 0.1, 0.0}),
                    Eigen::Vector3d(0.01, -0.02, 0.3) + sigma_position_m.cwiseProduct(noise())};
    out.tracker.t_ns.push_back(t_ns);
    out.tracker.T_world_marker.push_back(pose);
    out.probe.t_ns.push_back(t_ns);
    out.probe.accel_counts.emplace_back(0.0, 0.0, 9.8);
    out.probe.force_counts.push_back(0.0);
  }
  return out;
}

void write_to(const fs::path& folder, const Recording& recording) {
  fs::create_directory(folder);
  write_recording(folder, recording);
}

TEST(CalibrateOptics, TheCameraFromRenderedBoards) {
  const testkit::TempDir dir;
  render_boards(dir / "boards", 14);
  const std::string images = (dir / "boards").string();
  const std::string to = (dir / "calibration.json").string();
  const Outcome outcome =
      run({"calibrate", "camera", images, "--board", "9x6", "--square", "25mm", "--json", "-o", to});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json out = json::parse(outcome.out);
  const SimulatedCameraConfig truth;
  for (const auto& [key, wanted_px] :
       {std::pair{"fx", truth.fx_px}, {"fy", truth.fy_px}, {"cx", truth.cx_px}, {"cy", truth.cy_px}}) {
    const double error_px = out["stderr"][key].get<double>();
    EXPECT_GT(error_px, 0.0);
    EXPECT_LT(error_px, 2.0);
    // Four normal deviates; the finder's own bias is a hundredth of a pixel.
    EXPECT_NEAR(out["values"][key].get<double>(), wanted_px, 4.0 * error_px) << key;
  }
  EXPECT_NEAR(read_calibration(to).camera.value().fx, truth.fx_px, 3.0);

  // Squares counted for corners: the message gives the board that is there.
  const Outcome miscounted = run({"calibrate", "camera", images, "--board", "10x7", "--square", "25mm"});
  EXPECT_EQ(miscounted.code, 1);
  EXPECT_THAT(miscounted.err, HasSubstr("--board 9x6"));
  const std::string one = (dir / "boards" / "board10.pgm").string();
  const Outcome few = run({"calibrate", "camera", one, "--board", "9x6", "--square", "25mm"});
  EXPECT_EQ(few.code, 1);
  EXPECT_THAT(few.err, HasSubstr("at least 8 are needed"));
  EXPECT_EQ(run({"calibrate", "camera", images, "--board", "9by6", "--square", "25mm"}).code, 2);
}

TEST(CalibrateOptics, TheTrackersNoiseAtRest) {
  const testkit::TempDir dir;
  const Eigen::Vector3d sigma_m(1.5e-4, 1.3e-4, 5.4e-4);  // seed Fig. 9
  write_to(dir / "rest", at_rest(20.0, sigma_m, 2e-3));
  // What an earlier calibration said of the law does not outlive its figures.
  Calibration before;
  before.accelerometer.B = Eigen::Matrix3d::Identity();
  before.extra = {{"mine", 1}, {"tracker_noise_model", {{"formula", "old"}}}};
  const fs::path to = dir / "calibration.json";
  write_calibration(to, before);
  const std::string figure = (dir / "noise.svg").string();
  const Outcome outcome =
      run({"calibrate", "tracker", (dir / "rest").string(), "--json", "--figure", figure, "-o", to.string()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json out = json::parse(outcome.out);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double error_m = out["stderr"]["sigma_position_m"][axis].get<double>();
    EXPECT_NEAR(out["values"]["sigma_position_m"][axis].get<double>(), sigma_m[static_cast<Eigen::Index>(axis)],
                4.0 * error_m);
    // White noise: σ/√(2N), N poses of some 19 s.
    EXPECT_NEAR(error_m / sigma_m[static_cast<Eigen::Index>(axis)], 1.0 / std::sqrt(2.0 * 45.0 * 19.0), 0.006);
  }
  EXPECT_TRUE(out["model"].is_null());
  EXPECT_TRUE(fs::exists(figure));
  const Calibration after = read_calibration(to);
  EXPECT_NEAR(after.tracker.sigma_position_m.z(), 5.4e-4, 1e-4);
  EXPECT_EQ(after.extra.dump(), R"({"mine":1})");
  EXPECT_FALSE(after.tracker.noise_model);
  EXPECT_EQ(after.calibrated.at("tracker").trustworthy, true);

  write_to(dir / "short", at_rest(3.0, sigma_m, 2e-3));
  const Outcome refused = run({"calibrate", "tracker", (dir / "short").string()});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("clamp the probe"));
}

TEST(CalibrateOptics, TheLatencyFromAShakenRecording) {
  const testkit::TempDir dir;
  SimulationConfig config = without_link_faults(make_simulation_config("protoboard", "open"));
  config.step_s = 1e-4;
  const Eigen::Vector3d tip_in_marker_m(config.probe.tip_in_marker_m.data());
  ShakeMotion shake;
  Recording shaken = simulate_motion(config, shake_motion(shake, tip_in_marker_m), 10.0, "shaken");
  const double latency_s = shaken.calibration.tracker.latency_s;
  shaken.calibration.tracker.latency_s = 0.0;  // what is to be found is not given away
  write_to(dir / "shaken", shaken);
  const std::string to = (dir / "calibration.json").string();
  const Outcome outcome = run({"calibrate", "latency", (dir / "shaken").string(), "--json", "-o", to});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json out = json::parse(outcome.out);
  const double error_s = out["stderr"]["latency_s"].get<double>();
  EXPECT_GT(error_s, 0.0);
  EXPECT_LT(error_s, 5e-4);
  // The gyroscope's rows are late by its low-pass, a second-order Butterworth, so the tracker seems later by less.
  const double low_pass_s = std::numbers::sqrt2 / (2.0 * std::numbers::pi * config.probe.gyro_bandwidth_Hz);
  // 20 µs: rows are stamped to that.
  EXPECT_NEAR(out["values"]["latency_s"].get<double>(), latency_s - low_pass_s, 4.0 * error_s + 2e-5);
  const Calibration after = read_calibration(to);
  EXPECT_EQ(after.tracker.latency_s, out["values"]["latency_s"].get<double>());
  EXPECT_EQ(after.tracker.latency_sigma_s, error_s);

  write_to(dir / "still", simulate_motion(config, static_motion(shake.T_world_marker, tip_in_marker_m), 6.0, "still"));
  const Outcome refused = run({"calibrate", "latency", (dir / "still").string()});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("shake the probe"));
}

TEST(CalibrateOptics, FindsTheInertialSensor) {
  const testkit::TempDir dir;
  SimulationConfig config = without_link_faults(make_simulation_config("protoboard", "open"));
  config.step_s = 1e-4;
  const Eigen::Vector3d tip_in_marker_m(config.probe.tip_in_marker_m.data());
  ShakeMotion shake;
  Recording shaken = simulate_motion(config, shake_motion(shake, tip_in_marker_m), 12.0, "shaken");
  const Eigen::Vector3d truth_m(config.probe.sensor_in_marker_m.data());
  shaken.calibration.accelerometer.position_in_marker_m.reset();  // what is to be found is not given away
  shaken.calibration.tracker.latency_s = 0.0;
  write_to(dir / "shaken", shaken);
  const std::string to = (dir / "calibration.json").string();
  const Outcome outcome = run({"calibrate", "imu", (dir / "shaken").string(), "--json", "-o", to});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json out = json::parse(outcome.out);
  EXPECT_EQ(out["trustworthy"], true);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double error_m = out["stderr"]["accelerometer_position_in_marker_m"][axis].get<double>();
    EXPECT_GT(error_m, 0.0);
    EXPECT_LT(error_m, 2e-3);
    EXPECT_NEAR(out["values"]["accelerometer_position_in_marker_m"][axis].get<double>(),
                truth_m[static_cast<Eigen::Index>(axis)], 4.0 * error_m);
  }
  const Calibration after = read_calibration(to);
  ASSERT_TRUE(after.accelerometer.position_in_marker_m);
  EXPECT_EQ(after.accelerometer.position_in_marker_m->x(),
            out["values"]["accelerometer_position_in_marker_m"][0].get<double>());
  EXPECT_GT(after.accelerometer.position_sigma_m, 0.0);
  EXPECT_EQ(after.tracker.latency_s, out["values"]["latency_s"].get<double>());

  write_to(dir / "still", simulate_motion(config, static_motion(shake.T_world_marker, tip_in_marker_m), 6.0, "still"));
  const Outcome refused = run({"calibrate", "imu", (dir / "still").string()});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("rotate it"));
}

}  // namespace
}  // namespace asperity::cli
