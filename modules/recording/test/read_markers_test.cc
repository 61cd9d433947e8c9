#include "asperity/recording/read_markers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using testing::HasSubstr;

std::string marker(int id, const std::string& more = "") {
  return "{\"id\":" + std::to_string(id) +
         ",\"family\":\"tag36h11\",\"size_m\":0.046,\"T_marker_tag\":[0.01,0.02,0.03,1,0,0,0]" + more + "}";
}

void expect_error(const std::string& text, const std::string& part) {
  try {
    parse_markers(text, "markers.json");
    FAIL() << text;
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(part));
    EXPECT_THAT(error.what(), HasSubstr("markers.json"));
  }
}

TEST(ReadMarkers, MarkersAreRead) {
  const MarkerFile file = parse_markers("{\"markers\":[" + marker(3) + "," + marker(4) + "]}", "markers.json");
  ASSERT_EQ(file.markers.size(), 2U);
  EXPECT_EQ(file.markers[1].id, 4);
  EXPECT_EQ(file.markers[1].size_m, 0.046);
  EXPECT_EQ(file.markers[1].T_marker_tag.translation_m, Eigen::Vector3d(0.01, 0.02, 0.03));
  EXPECT_TRUE(file.markers[1].T_marker_tag.rotation.isApprox(Eigen::Quaterniond::Identity()));
}

TEST(ReadMarkers, OpenCvsFrameIsConverted) {
  const MarkerFile file = parse_markers("{\"tag_frame\":\"opencv\",\"markers\":[" + marker(3) + "]}", "markers.json");
  EXPECT_EQ(file.declared, TagFrame::kOpenCv);
  EXPECT_EQ(parse_markers("{\"tag_frame\":\"opencv_upright\",\"markers\":[" + marker(3) + "]}", "m.json").declared,
            TagFrame::kOpenCvUpright);
  EXPECT_TRUE((R_frame_tag(TagFrame::kOpenCvUpright, "tag36h11") * Eigen::Vector3d::UnitX())
                  .isApprox(Eigen::Vector3d::UnitX()));
  // OpenCV's picture of this family is turned by half a turn: seen upright as AprilTag draws it, OpenCV's x points
  // left, y down and z out of the tag.
  const Eigen::Quaterniond& R = file.markers[0].T_marker_tag.rotation;
  EXPECT_TRUE((R * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitX()));
  EXPECT_TRUE((R * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE((R * Eigen::Vector3d::UnitZ()).isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(
      (R_frame_tag(TagFrame::kOpenCv, "DICT_4X4_50") * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitX()));
}

TEST(ReadMarkers, ACalibrationWillDoWhateverElseItHolds) {
  const std::string text =
      "{\"format\":\"asperity-calibration\",\"version\":1,\"camera\":{\"width\":640,\"height\":480,"
      "\"fx\":600,\"fy\":601,\"cx\":320,\"cy\":240,\"distortion\":[0.1,0,0,0,0]},\"markers\":[" +
      marker(1) + "],\"extra\":{\"tag_frame\":\"opencv\"}}";
  EXPECT_EQ(parse_markers(text, "calibration.json").declared, TagFrame::kOpenCv);
  const CameraCalibration camera = parse_camera(text, "calibration.json");
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.fy, 601.0);
  EXPECT_EQ(camera.distortion.size(), 5U);
}

TEST(ReadMarkers, WhatIsWrongIsNamed) {
  expect_error("{}", "'markers'");
  expect_error("{\"markers\":[]}", "1 to 1000");
  expect_error("{\"markers\":{}}", "array");
  expect_error("{\"markers\":[" + marker(3) + "," + marker(3) + "]}", "given twice");
  expect_error("{\"markers\":[" + marker(-1) + "]}", "markers[0].id");
  expect_error("{\"markers\":[" + marker(3, ",\"colour\":1") + "]}", "colour");
  expect_error("{\"markers\":[" + marker(3) + "],\"more\":1}", "more");
  expect_error("{\"tag_frame\":\"left\",\"markers\":[" + marker(3) + "]}", "apriltag or opencv");
  expect_error("[1]", "object");
  std::string many = "{\"markers\":[" + marker(0);
  for (int i = 1; i < 1001; ++i) many += "," + marker(i);
  expect_error(many + "]}", "1 to 1000");
}

TEST(ReadMarkers, ADictionarysFileStaysInTheFolder) {
  const testkit::TempDir folder;
  const auto write = [&](const std::string& family) {
    std::string text = "{\"markers\":[" + marker(3) + "]}";
    text.replace(text.find("tag36h11"), 8, family);
    write_file(folder.path() / "markers.json", text);
    return folder.path() / "markers.json";
  };
  const MarkerFile file = read_markers(write("aruco:own.yml"));
  EXPECT_EQ(file.markers[0].family, "aruco:" + (folder.path() / "own.yml").string());
  EXPECT_EQ(read_markers(write("aruco:DICT_4X4_50")).markers[0].family, "aruco:DICT_4X4_50");
  EXPECT_THROW(read_markers(write("aruco:../own.yml")), Error);
  EXPECT_THROW(read_markers(write("aruco:/etc/own.yml")), Error);
}

TEST(ReadMarkers, AFileWithoutACameraIsRefused) {
  EXPECT_THROW(parse_camera("{\"format\":\"asperity-calibration\",\"version\":1}", "c.json"), Error);
  EXPECT_THROW(parse_camera("{\"camera\":{}}", "c.json"), Error);
}

}  // namespace
}  // namespace asperity
