#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using ::testing::HasSubstr;

TEST(CheckRig, WritesTheGratingAndNothingOverIt) {
  const testkit::TempDir dir;
  const std::string file = (dir / "grating.stl").string();
  const Outcome made = run({"check-rig", "--artefact", "--depth", "0.1mm", "-o", file});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("triangles, in mm"));
  EXPECT_EQ(run({"check-rig", "--artefact", "-o", file}).code, 1);
  EXPECT_EQ(run({"check-rig", "--artefact"}).code, 2);
  EXPECT_EQ(run({"check-rig"}).code, 2);
  EXPECT_EQ(run({"check-rig", "x", "--depth", "1m"}).code, 2);
}

TEST(CheckRig, JudgesAStrokeByItsSegments) {
  const testkit::TempDir dir;
  const std::string stroke = (dir / "stroke").string();
  ASSERT_EQ(run({"simulate", "--surface", "sine", "--set", "hand.length_m=0.04", "-o", stroke, "--quiet"}).code, 0);
  const std::string report = (dir / "report.json").string();
  const Outcome right = run({"check-rig", stroke, "--json", "-o", report});
  ASSERT_EQ(right.code, 0) << right.err;
  const auto json = nlohmann::json::parse(right.out);
  EXPECT_EQ(json["format"], "asperity-rig-check");
  EXPECT_TRUE(json["right"]);
  EXPECT_THAT(std::string(json["verdict"]), HasSubstr("limited: 1 stroke of 5"));
  EXPECT_THAT(right.err, HasSubstr("limited: 1 stroke of 5"));
  // The recording's folder and the report, nothing else.
  EXPECT_EQ(contents(dir.path()).size(), contents(stroke).size() + 2);

  // A grating of another pitch than the one that was scanned; the report of before is ours to replace.
  const Outcome wrong = run({"check-rig", stroke, "--pitch", "1.9mm", "-o", report});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("invalid: the pitch is"));
  EXPECT_THAT(wrong.out, HasSubstr("NOT RIGHT"));
  const auto judged = nlohmann::json::parse(run({"check-rig", stroke, "--pitch", "1.9mm", "--json"}).out);
  EXPECT_EQ(judged["trustworthy"], false);
  EXPECT_EQ(judged["verdicts"][0]["code"], "pitch_off");
  EXPECT_EQ(judged["verdicts"][0]["severity"], "invalid");
}

}  // namespace
}  // namespace asperity::cli
