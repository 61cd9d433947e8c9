#include "asperity/pipeline/true_pose.h"

#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

Recording with_extra(const std::string& extra) {
  Recording recording;
  recording.info.extra_json = extra;
  return recording;
}

TEST(TruePose, IsReadFromTheExtras) {
  const auto pose = true_pose(with_extra(R"({"T_mesh_world":[1,2,3,0,1,0,0]})"));
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->translation_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ((*pose * Eigen::Vector3d(0, 1, 0)), Eigen::Vector3d(1, 1, 3));  // half a turn about x
}

TEST(TruePose, IsNoneWhereNothingIsKnown) {
  EXPECT_FALSE(true_pose(with_extra("{}")));
  EXPECT_FALSE(true_pose(with_extra(R"({"note":"a pebble"})")));
}

TEST(TruePose, RefusesWhatIsNoPose) {
  for (const char* bad : {"7", "[1,2,3]", "[0,0,0,2,0,0,0]", R"([0,0,0,1,0,0,"0"])", "[0,0,0,1,0,0,null]"}) {
    EXPECT_THROW(true_pose(with_extra(std::string("{\"T_mesh_world\":") + bad + "}")), Error) << bad;
  }
}

}  // namespace
}  // namespace asperity
