#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "asperity/json/parse_json.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/parse_recording.h"
#include "asperity/recording/uncalibrated.h"

// What the program knows of `extra` has fields; the files' keys and bytes are those of before it had them.
namespace asperity {
namespace {

using testing::HasSubstr;

RecordingInfo parsed(const std::string& extra) {
  return parse_recording_info(R"({"format":"asperity-recording","version":1,"extra":)" + extra + "}", "r.json");
}

TEST(KnownExtra, RecordersStateIsReadAndWrittenAsItWas) {
  const std::string extra =
      R"({"note":[1,2],"recorder":{"discarded":[{"end_ns":9,"name":"spoilt","start_ns":6}],"discarded_segments":1,)"
      R"("discarded_until_ns":9,"gravity":{"measured":true,"scatter_mps2":[0.25,null,0.0],"windows_at_rest":2},)"
      R"("last_segment_is_open":false,"mode":"auto","probe_firmware":"1.2","probe_name":"open","state":"recording"}})";
  const RecordingInfo info = parsed(extra);
  ASSERT_TRUE(info.recorder);
  EXPECT_EQ(info.recorder->state, "recording");
  EXPECT_EQ(info.recorder->mode, "auto");
  EXPECT_EQ(info.recorder->last_segment_is_open, false);
  EXPECT_EQ(info.recorder->discarded_until_ns, 9);
  EXPECT_EQ(info.recorder->discarded_segments, 1);
  ASSERT_EQ(info.recorder->discarded.size(), 1U);
  EXPECT_EQ(info.recorder->discarded[0].name, "spoilt");
  ASSERT_TRUE(info.recorder->gravity);
  EXPECT_EQ(info.recorder->gravity->windows_at_rest, 2);
  EXPECT_EQ(info.recorder->gravity->scatter_mps2.x(), 0.25);
  EXPECT_TRUE(std::isnan(info.recorder->gravity->scatter_mps2.y()));
  EXPECT_EQ(info.recorder->probe_name, "open");
  EXPECT_EQ(info.extra.dump_sorted(), R"({"note":[1,2]})");
  EXPECT_THAT(format_recording_info(info), HasSubstr(extra));
}

TEST(KnownExtra, OtherFormsStayAsTheyAre) {
  for (const char* extra : {R"({"recorder":7})", R"({"recorder":{"gravity":{"measured":1},"state":7}})",
                            R"({"force_sensor":true})", R"({"T_mesh_world":[[1,0],[0,1]]})"}) {
    const RecordingInfo info = parsed(extra);
    EXPECT_EQ(info.extra.dump_sorted(), extra);
    EXPECT_TRUE(info.has_force_sensor);
    EXPECT_THAT(format_recording_info(info), HasSubstr(extra));
  }
}

TEST(KnownExtra, PoseAndForceSensor) {
  const std::string extra = R"({"T_mesh_world":[0.125,0,-2,1,0,0,0],"force_sensor":false,"imported":true})";
  const RecordingInfo info = parsed(extra);
  EXPECT_FALSE(info.has_force_sensor);
  ASSERT_TRUE(info.T_mesh_world);
  EXPECT_EQ(info.T_mesh_world->translation_m, Eigen::Vector3d(0.125, 0.0, -2.0));
  EXPECT_EQ(info.extra.dump_sorted(), R"({"imported":true})");
  EXPECT_THAT(format_recording_info(info), HasSubstr(extra));
}

TEST(KnownExtra, WhatCalibrationsSaid) {
  Calibration calibration = make_uncalibrated(2.0, 0.0, 0.5);
  calibration.calibrated["force"] = {false, "few", parse_json(R"({"values":{"a":1.0}})")};
  calibration.extra = parse_json(R"({"calibrated":{"own":3},"mine":1})");
  const std::string text = format_calibration(calibration);
  EXPECT_THAT(text, HasSubstr(R"({"calibrated":{"force":{"trustworthy":false,"values":{"a":1.0},"verdict":"few"},)"
                              R"("own":3},"mine":1,"uncalibrated":true})"));
  const Calibration back = parse_calibration(text, "c.json");
  EXPECT_TRUE(back.uncalibrated);
  EXPECT_EQ(back.calibrated.at("force").trustworthy, false);
  EXPECT_EQ(back.calibrated.at("force").verdict, "few");
  EXPECT_EQ(back.calibrated.at("force").details.dump(), R"({"values":{"a":1.0}})");
  EXPECT_EQ(back.extra, calibration.extra);
  EXPECT_EQ(format_calibration(back), text);
}

TEST(KnownExtra, WhereARecordingComesFrom) {
  const std::string simulated =
      R"({"path_length_m":0.0625,"simulation":{"hand.strokes":2,"live":true,"shape.kind":"mesh"}})";
  const RecordingInfo info = parsed(simulated);
  ASSERT_TRUE(info.simulation);
  EXPECT_TRUE(info.simulation->is_live);
  EXPECT_EQ(info.simulation->path_length_m, 0.0625);
  EXPECT_EQ(info.simulation->settings.dump(), R"({"hand.strokes":2,"shape.kind":"mesh"})");
  EXPECT_TRUE(info.extra.empty());
  EXPECT_THAT(format_recording_info(info), HasSubstr(simulated));

  const std::string imported =
      R"({"imported":true,"note":1,"pose_noise_m":[0.0,0.5,1.0],"pose_rate_hz":60.0,"rotation_noise_rad":[0.0,0.0,0.0],)"
      R"("seed":7})";
  const RecordingInfo foreign = parsed(imported);
  ASSERT_TRUE(foreign.imported);
  EXPECT_EQ(foreign.imported->pose_rate_Hz, 60.0);
  EXPECT_EQ(foreign.imported->pose_noise_m[1], 0.5);
  EXPECT_EQ(foreign.imported->seed, 7);
  EXPECT_EQ(foreign.extra.dump(), R"({"note":1})");
  EXPECT_THAT(format_recording_info(foreign), HasSubstr(imported));

  EXPECT_TRUE(parsed(R"({"replayed":true})").is_replayed);
  EXPECT_THAT(format_recording_info(parsed(R"({"replayed":true})")), HasSubstr(R"({"replayed":true})"));
}

TEST(KnownExtra, OriginsOfOtherFormsStayAsTheyAre) {
  for (const char* extra : {R"({"simulation":"mine"})", R"({"path_length_m":2.0,"simulation":{"live":1}})",
                            R"({"imported":true,"pose_noise_m":[0,0.5,1],"pose_rate_hz":60})", R"({"replayed":false})"})
    EXPECT_THAT(format_recording_info(parsed(extra)), HasSubstr(extra)) << extra;
}

TEST(KnownExtra, TrackersNoiseAndTagFrame) {
  Calibration calibration = make_uncalibrated(2.0, 0.0, 0.5);
  TrackerNoiseModel& model = calibration.tracker.noise_model.emplace();
  model.across_m = {1e-4, 1e-6, 1.0, 0.5, 0.25, 1.01, std::nan(""), 12.5, 11};
  model.farthest_m = 0.4;
  calibration.tag_frame = TagFrame::kOpenCv;
  const std::string text = format_calibration(calibration);
  EXPECT_THAT(text, HasSubstr(R"("tag_frame":"opencv","tracker_noise_model":{"farthest_m":0.4,"formula":")"));
  EXPECT_THAT(text, HasSubstr(R"("measured_distance_power_stderr":null)"));
  const Calibration back = parse_calibration(text, "c.json");
  ASSERT_TRUE(back.tracker.noise_model);
  EXPECT_EQ(back.tracker.noise_model->across_m.chi_square, 12.5);
  EXPECT_EQ(back.tracker.noise_model->across_m.degrees_of_freedom, 11);
  EXPECT_TRUE(std::isnan(back.tracker.noise_model->across_m.measured_power_error));
  EXPECT_EQ(back.tag_frame, TagFrame::kOpenCv);
  EXPECT_TRUE(back.extra.empty());
  EXPECT_EQ(format_calibration(back), text);

  std::string with_more = text;
  with_more.replace(with_more.find(R"("farthest_m":0.4)"), 16, R"("farthest_m":0.4,"mine":1)");
  const Calibration other = parse_calibration(with_more, "c.json");
  EXPECT_FALSE(other.tracker.noise_model);
  EXPECT_EQ(other.extra.size(), 1U);
  EXPECT_NE(format_calibration(other).find(R"("mine":1)"), std::string::npos);
}

}  // namespace
}  // namespace asperity
