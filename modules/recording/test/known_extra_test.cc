#include <gmock/gmock.h>

#include <cmath>
#include <string>

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
  EXPECT_EQ(info.extra_json, R"({"note":[1,2]})");
  EXPECT_THAT(format_recording_info(info), HasSubstr(extra));
}

TEST(KnownExtra, OtherFormsStayAsTheyAre) {
  for (const char* extra : {R"({"recorder":7})", R"({"recorder":{"gravity":{"measured":1},"state":7}})",
                            R"({"force_sensor":true})", R"({"T_mesh_world":[[1,0],[0,1]]})"}) {
    const RecordingInfo info = parsed(extra);
    EXPECT_EQ(info.extra_json, extra);
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
  EXPECT_EQ(info.extra_json, R"({"imported":true})");
  EXPECT_THAT(format_recording_info(info), HasSubstr(extra));
}

TEST(KnownExtra, WhatCalibrationsSaid) {
  Calibration calibration = make_uncalibrated(2.0, 0.0, 0.5);
  calibration.calibrated["force"] = {false, "few", R"({"values":{"a":1.0}})"};
  calibration.extra_json = R"({"calibrated":{"own":3},"mine":1})";
  const std::string text = format_calibration(calibration);
  EXPECT_THAT(text, HasSubstr(R"({"calibrated":{"force":{"trustworthy":false,"values":{"a":1.0},"verdict":"few"},)"
                              R"("own":3},"mine":1,"uncalibrated":true})"));
  const Calibration back = parse_calibration(text, "c.json");
  EXPECT_TRUE(back.uncalibrated);
  EXPECT_EQ(back.calibrated.at("force").trustworthy, false);
  EXPECT_EQ(back.calibrated.at("force").verdict, "few");
  EXPECT_EQ(back.calibrated.at("force").details_json, R"({"values":{"a":1.0}})");
  EXPECT_EQ(back.extra_json, calibration.extra_json);
  EXPECT_EQ(format_calibration(back), text);
}

}  // namespace
}  // namespace asperity
