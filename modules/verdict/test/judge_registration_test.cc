#include "asperity/verdict/judge_registration.h"

#include <gmock/gmock.h>

namespace asperity {
namespace {

TEST(JudgeRegistration, NamesWhatIsWrongWithAPose) {
  PoseEvidence evidence;
  evidence.points = 100;
  evidence.outliers = 50;
  evidence.iterations = 1;
  EXPECT_TRUE(judge_registration(evidence).empty());

  evidence.outliers = 51;
  evidence.converged = false;
  evidence.ambiguous = true;
  evidence.rival_distance_m = 0.0415;
  evidence.rival_rotation_rad = 3.0;
  const Verdicts verdicts = judge_registration(evidence);
  ASSERT_EQ(verdicts.size(), 3U);
  EXPECT_EQ(verdicts[0].code, "pose_not_converged");
  EXPECT_THAT(verdicts[0].message, testing::HasSubstr("in 1 iteration"));
  EXPECT_EQ(verdicts[1].code, "off_mesh");
  EXPECT_THAT(verdicts[1].message, testing::HasSubstr("only 49 %"));
  EXPECT_EQ(verdicts[2].code, "pose_ambiguous");
  EXPECT_THAT(verdicts[2].message, testing::HasSubstr("41.5 mm and 171.9 degrees"));
  EXPECT_FALSE(is_trustworthy(verdicts));
}

}  // namespace
}  // namespace asperity
