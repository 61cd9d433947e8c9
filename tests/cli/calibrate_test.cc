#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "asperity/base/csv.h"
#include "asperity/base/random.h"
#include "asperity/base/text.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

// Seed Fig. 11(a).
const char* const kFigure11 =
    "counts,force_N\n48,0\n95,1.14\n100,1.24\n105,1.34\n115,1.54\n128,1.79\n155,2.29\n161,2.44\n185,3.54\n195,3.84\n";

struct Reading {
  double t_s = 0.0;
  Eigen::Vector3d counts;
};

// Thirty poses of a second and a half, a coarse spiral over all directions, with brisk turns between.
std::vector<Reading> held_by_hand(double counts_per_mps2) {
  std::vector<Reading> out;
  Random random(5);
  double t_s = 0.0;
  const auto direction = [](double p) {
    const double z = 1.0 - 2.0 * (p + 0.5) / 30.0;
    const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
    return Eigen::Vector3d(r * std::cos(2.4 * p), r * std::sin(2.4 * p), z);
  };
  for (int i = 0; i < 30 * 100; ++i, t_s += 0.02) {
    const int pose = i / 100;
    const double turned = std::max((i % 100 - 75) / 25.0, 0.0);
    const Eigen::Vector3d f = 9.80665 * ((1.0 - turned) * direction(pose) + turned * direction(pose + 1));
    Eigen::Vector3d counts;
    for (int axis = 0; axis < 3; ++axis)
      counts[axis] = std::round(30000.0 + counts_per_mps2 * f[axis] + 3.0 * random.normal());
    out.push_back({t_s, counts});
  }
  return out;
}

std::string table_of(const std::vector<Reading>& readings) {
  std::string out = "t_s,accel_i,accel_j,accel_k\n";
  for (const Reading& reading : readings) {
    out += number_text(reading.t_s);
    for (int axis = 0; axis < 3; ++axis) out += ',' + number_text(reading.counts[axis]);
    out += '\n';
  }
  return out;
}

Recording swung() {
  Recording out;
  out.calibration.accelerometer.B = Eigen::Matrix3d::Identity();
  out.calibration.force.axis_in_marker = Eigen::Vector3d::UnitZ();
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const double t_s = i / 45.0;
    const Eigen::Vector3d turn(0.5 * std::sin(2.8 * t_s), 0.5 * std::sin(1.9 * t_s), 0.3 * std::sin(1.1 * t_s));
    Pose pose{exp_rotation(turn), Eigen::Vector3d::Zero()};
    pose.translation_m = Eigen::Vector3d(0.05, 0.1, 0.4) - pose.rotation * Eigen::Vector3d(0.001, 0.002, -0.11);
    pose.translation_m += 1e-4 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    const auto t_ns = static_cast<std::int64_t>(1e9 + 1e9 * t_s);
    out.tracker.t_ns.push_back(t_ns);
    out.tracker.T_world_marker.push_back(pose);
    out.probe.t_ns.push_back(t_ns);
    out.probe.accel_counts.emplace_back(0.0, 0.0, 9.8);
    out.probe.force_counts.push_back(0.0);
  }
  return out;
}

TEST(Calibrate, ForceOfFigure11) {
  const testkit::TempDir dir;
  const std::string file = (dir / "force.csv").string();
  write_text(file, kFigure11);
  const Outcome outcome = run({"calibrate", "force", file, "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json out = json::parse(outcome.out);
  EXPECT_EQ(out["format"], "asperity-calibrate");
  EXPECT_EQ(out["kind"], "force");
  EXPECT_NEAR(out["values"]["newton_per_count"].get<double>(), 0.025095, 5e-7);
  EXPECT_NEAR(out["values"]["offset_newton"].get<double>(), -1.313768, 1e-6);
  EXPECT_NEAR(out["residuals"]["residual_newton"].get<double>(), 0.196, 5e-4);
  EXPECT_TRUE(out["trustworthy"].get<bool>());
  EXPECT_THAT(run({"calibrate", "force", file}).out, HasSubstr("N, 8 degrees of freedom"));
}

TEST(Calibrate, EachKindReplacesItsOwnPartAlone) {
  const testkit::TempDir dir;
  const std::string force = (dir / "force.csv").string();
  const std::string accel = (dir / "accel.csv").string();
  const std::string to = (dir / "calibration.json").string();
  write_text(force, kFigure11);
  write_text(accel, table_of(held_by_hand(400.0)));
  const std::filesystem::path recording = dir / "swing";
  std::filesystem::create_directory(recording);
  write_recording(recording, swung());
  ASSERT_EQ(run({"calibrate", "force", force, "-o", to}).code, 0);
  const Outcome field = run({"calibrate", "accel", accel, "-o", to});
  ASSERT_EQ(field.code, 0) << field.err << field.out;
  const Outcome tip = run({"calibrate", "tip", recording.string(), "-o", to});
  ASSERT_EQ(tip.code, 0) << tip.err << tip.out;

  const Calibration all = read_calibration(to);
  EXPECT_NEAR(all.force.newton_per_count, 0.025095, 5e-7);
  EXPECT_NEAR(all.accelerometer.B(0, 0), 400.0, 1.0);
  EXPECT_FALSE(all.accelerometer.rotation_known);
  EXPECT_LT((all.tip_in_marker_m - Eigen::Vector3d(0.001, 0.002, -0.11)).norm(), 2e-4);
  for (const char* kind : {"force", "accel", "tip"}) {
    ASSERT_TRUE(all.calibrated.contains(kind)) << kind;
    EXPECT_EQ(all.calibrated.at(kind).trustworthy, true);
    EXPECT_TRUE(all.calibrated.at(kind).details.contains("stderr"));
  }
  const std::string before = read_file(to, 1 << 20);
  ASSERT_EQ(run({"calibrate", "force", force, "-o", to}).code, 0);
  EXPECT_EQ(read_file(to, 1 << 20), before) << "the same input gives the same bytes";
}

// What `record --uncalibrated` without a camera leaves: poses that turn every side up are out of any camera's sight.
TEST(Calibrate, AccelFromARecordingWithoutATracker) {
  const testkit::TempDir dir;
  Recording recording = swung();
  recording.probe = {};
  for (const Reading& reading : held_by_hand(400.0)) {
    recording.probe.t_ns.push_back(static_cast<std::int64_t>(1e9 + 1e9 * reading.t_s));
    recording.probe.accel_counts.push_back(reading.counts);
    recording.probe.force_counts.push_back(0.0);
  }
  const std::filesystem::path folder = dir / "held";
  std::filesystem::create_directory(folder);
  write_recording(folder, recording);
  write_text(folder / "tracker.csv", "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz\n");
  const Outcome outcome = run({"calibrate", "accel", folder.string(), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json values = json::parse(outcome.out)["values"];
  for (const json& scale : values["scale_counts_per_mps2"]) EXPECT_NEAR(scale.get<double>(), 400.0, 1.0);
}

TEST(Calibrate, NothingIsWrittenOverAStrangersFileNorFromDataThatSayNothing) {
  const testkit::TempDir dir;
  const std::string force = (dir / "force.csv").string();
  const std::string other = (dir / "other.json").string();
  write_text(force, kFigure11);
  write_text(other, "{\"mine\":1}\n");
  const Outcome stranger = run({"calibrate", "force", force, "-o", other});
  EXPECT_EQ(stranger.code, 1);
  EXPECT_THAT(stranger.err, HasSubstr("nothing was changed"));
  EXPECT_EQ(run({"calibrate", "force", force, "-o", force}).code, 1);

  write_text(force, "counts,force_N\n100,1\n100,2\n100,3\n");
  const std::filesystem::path to = dir / "calibration.json";
  const Outcome alike = run({"calibrate", "force", force, "-o", to.string()});
  EXPECT_EQ(alike.code, 1);
  EXPECT_THAT(alike.err, HasSubstr("five or more forces"));
  EXPECT_FALSE(std::filesystem::exists(to));
}

TEST(Calibrate, WhatIsNotToBeTrustedEndsWith3AndSaysSoInTheFile) {
  const testkit::TempDir dir;
  const std::string force = (dir / "force.csv").string();
  write_text(force, "counts,force_N\n100,1\n150,1.9\n200,3.2\n");
  const std::string to = (dir / "calibration.json").string();
  const Outcome few = run({"calibrate", "force", force, "-o", to});
  EXPECT_EQ(few.code, 3);
  EXPECT_THAT(few.out, HasSubstr("INVALID: "));
  EXPECT_EQ(read_calibration(to).calibrated.at("force").trustworthy, false);
  const json written = json::parse(read_file(to, 1 << 20))["extra"]["calibrated"]["force"];
  EXPECT_EQ(written["trustworthy"], false);
}

TEST(Calibrate, KindsAreNamedInHelp) {
  const Outcome help = run({"calibrate", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* kind : {"camera", "tracker", "force", "accel", "tip", "latency"}) {
    EXPECT_THAT(help.out, HasSubstr(kind));
    EXPECT_EQ(run({"calibrate", kind, "--print-config"}).code, 0);
    EXPECT_EQ(run({"calibrate", kind}).code, 2);
  }
}

}  // namespace
}  // namespace asperity::cli
