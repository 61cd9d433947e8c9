#include "asperity/tracking/find_tag_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "asperity/recording/camera_model.h"
#include "asperity/recording/read_markers.h"

namespace asperity {
namespace {

using testing::HasSubstr;

CameraCalibration camera_640() {
  CameraCalibration camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 600.0;
  camera.cx = 320.0;
  camera.cy = 240.0;
  return camera;
}

// Three tags that no turn of their frames maps onto each other.
std::vector<MarkerPlacement> odd_body() {
  std::vector<MarkerPlacement> body(3);
  for (int i = 0; i < 3; ++i) {
    MarkerPlacement& tag = body[static_cast<std::size_t>(i)];
    tag.id = i;
    tag.family = "tag36h11";
    tag.size_m = 0.03;
    tag.T_marker_tag = {exp_rotation({0.1 * i, 0.6 * (i - 1), 0.3 * i}), {0.05 * (i - 1), 0.01 * i, 0.012 * i * i}};
  }
  return body;
}

std::vector<std::vector<SeenTag>> frames_of(const std::vector<MarkerPlacement>& body) {
  std::vector<std::vector<SeenTag>> out;
  for (int f = 0; f < 3; ++f) {
    const Pose pose{exp_rotation({0.3, 0.1 * f, 0.8 * f}), {0.01 * f, 0.0, 0.35}};
    std::vector<SeenTag> seen;
    for (std::size_t t = 0; t < body.size(); ++t) {
      SeenTag tag;
      tag.tag = t;
      const auto corners_m = tag_corners_m(body[t]);
      for (int i = 0; i < 4; ++i) tag.corners_px.col(i) = *project(camera_640(), pose * corners_m.col(i));
      seen.push_back(tag);
    }
    out.push_back(seen);
  }
  return out;
}

TEST(FindTagFrame, ABodyThatMeansWhatItSaysStaysAsItIs) {
  const auto body = odd_body();
  const auto finding = find_tag_frame(camera_640(), body, frames_of(body));
  EXPECT_TRUE(finding.as_declared);
  EXPECT_TRUE(finding.determined);
  EXPECT_LT(finding.error_px, 0.01);
}

TEST(FindTagFrame, EachOfTheOtherSevenIsFound) {
  const auto body = odd_body();
  const auto frames = frames_of(body);
  for (int turn = 0; turn < 4; ++turn) {
    for (const bool out_of_tag : {false, true}) {
      if (turn == 0 && !out_of_tag) continue;
      const Eigen::Quaterniond R = exp_rotation({0.0, 0.0, turn * std::numbers::pi / 2.0}) *
                                   (out_of_tag ? Eigen::Quaterniond(0, 1, 0, 0) : Eigen::Quaterniond::Identity());
      // Written by one whose frames are R's: T_marker_frame = T_marker_tag R⁻¹.
      const auto written = with_tag_frame(body, R.conjugate());
      const auto finding = find_tag_frame(camera_640(), written, frames);
      ASSERT_TRUE(finding.determined);
      EXPECT_FALSE(finding.as_declared);
      EXPECT_LT(finding.R_frame_tag.angularDistance(R), 1e-6) << turn << out_of_tag;
      EXPECT_GT(finding.declared_error_px, 1.0);
      const auto meant = with_tag_frame(written, finding.R_frame_tag);
      for (std::size_t i = 0; i < body.size(); ++i) {
        EXPECT_LT(meant[i].T_marker_tag.rotation.angularDistance(body[i].T_marker_tag.rotation), 1e-6);
      }
    }
  }
}

TEST(FindTagFrame, OpenCvsIsCalledSo) {
  const auto body = odd_body();
  const auto written = with_tag_frame(body, R_frame_tag(TagFrame::kOpenCv, "tag36h11").conjugate());
  const auto finding = find_tag_frame(camera_640(), written, frames_of(body));
  EXPECT_THAT(finding.description, HasSubstr("OpenCV"));
}

// Two tags in a plane, one above the other: half a turn about the line across them maps the body onto itself, so that
// two frames fit alike.
TEST(FindTagFrame, OfFramesThatFitAlikeTheMostUsualIsTakenAndTheOthersAreTold) {
  std::vector<MarkerPlacement> body(2);
  for (int i = 0; i < 2; ++i) {
    body[static_cast<std::size_t>(i)] = {i, "tag36h11", 0.046, {Eigen::Quaterniond::Identity(), {0.0, 0.058 * i, 0.0}}};
  }
  const Eigen::Quaterniond R = R_frame_tag(TagFrame::kOpenCvUpright, "tag36h11");
  const auto finding = find_tag_frame(camera_640(), with_tag_frame(body, R.conjugate()), frames_of(body));
  ASSERT_TRUE(finding.determined);
  EXPECT_FALSE(finding.as_declared);
  EXPECT_LT(finding.R_frame_tag.angularDistance(R), 1e-6);
  EXPECT_EQ(finding.description, "x right, y up, z out of the tag, upright as libapriltag draws it");
  EXPECT_THAT(finding.as_good, testing::ElementsAre("x left, y up, z into the tag, upright as libapriltag draws it"));
}

TEST(FindTagFrame, ABodyThatTellsTheFramesApartHasNoOthers) {
  const auto body = odd_body();
  const auto written = with_tag_frame(body, R_frame_tag(TagFrame::kOpenCv, "tag36h11").conjugate());
  EXPECT_TRUE(find_tag_frame(camera_640(), written, frames_of(body)).as_good.empty());
}

TEST(FindTagFrame, WhatFitsInNoWayIsLeftAsDeclared) {
  auto body = odd_body();
  const auto frames = frames_of(body);
  body[1].T_marker_tag.translation_m.x() += 0.02;
  body[2].T_marker_tag.translation_m.y() += 0.03;
  const auto finding = find_tag_frame(camera_640(), body, frames);
  EXPECT_TRUE(finding.as_declared);
  EXPECT_FALSE(finding.determined);
}

}  // namespace
}  // namespace asperity
