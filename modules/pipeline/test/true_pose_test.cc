#include "asperity/pipeline/true_pose.h"

#include <gtest/gtest.h>

#include "asperity/recording/parse_recording.h"

namespace asperity {
namespace {

Recording with_extra(const std::string& extra) {
  Recording recording;
  recording.info = parse_recording_info(R"({"format":"asperity-recording","version":1,"extra":)" + extra + "}", "r");
  return recording;
}

TEST(TruePose, IsReadFromTheExtras) {
  const Recording recording = with_extra(R"({"T_mesh_world":[1,2,3,0,1,0,0],"note":7})");
  const auto pose = true_pose(recording);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->translation_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ((*pose * Eigen::Vector3d(0, 1, 0)), Eigen::Vector3d(1, 1, 3));  // half a turn about x
  EXPECT_EQ(recording.info.extra.dump_sorted(), R"({"note":7})");
}

TEST(TruePose, IsNoneWhereNothingIsKnown) {
  EXPECT_FALSE(true_pose(with_extra("{}")));
  EXPECT_FALSE(true_pose(with_extra(R"({"note":"a pebble"})")));
}

// Others may have put something else under the name: it stays theirs.
TEST(TruePose, WhatIsNoPoseStaysAStrangers) {
  for (const char* other : {"7", "[1,2,3]", "[0,0,0,2,0,0,0]", R"([0,0,0,1,0,0,"0"])", "[0,0,0,1,0,0,null]"}) {
    const std::string extra = std::string("{\"T_mesh_world\":") + other + "}";
    EXPECT_FALSE(true_pose(with_extra(extra))) << other;
    EXPECT_EQ(with_extra(extra).info.extra.dump_sorted(), extra);
  }
}

}  // namespace
}  // namespace asperity
