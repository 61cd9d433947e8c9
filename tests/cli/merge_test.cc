#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// A stroke of 40 mm over sandpaper; `line` is the relief's and the path's.
void simulate_stroke(const fs::path& folder, int line, int seed) {
  const Outcome outcome = run({"simulate", "--surface", "sandpaper", "--seed", std::to_string(seed), "--set",
                               "hand.length_m=0.04", "--set", "surface.seed=" + std::to_string(line), "--set",
                               "hand.path_seed=" + std::to_string(line), "-o", folder.string()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
}

TEST(Merge, StrokesOverOneLineAndRefusesOthers) {
  const testkit::TempDir dir;
  simulate_stroke(dir / "a", 1, 11);
  simulate_stroke(dir / "b", 1, 12);
  simulate_stroke(dir / "c", 2, 13);
  const auto path = [&](const char* name) { return (dir / name).string(); };

  const Outcome merged = run({"merge", path("a"), path("b"), "-o", path("out"), "--json"});
  ASSERT_EQ(merged.code, 0) << merged.err;
  const auto json = nlohmann::json::parse(merged.out);
  ASSERT_EQ(json["passes"].size(), 2u);
  for (const auto& pass : json["passes"]) {
    EXPECT_TRUE(pass["used"].get<bool>());
    EXPECT_EQ(pass["direction"], "forward");
    EXPECT_GT(pass["coherence"].get<double>(), 0.9);
    EXPECT_GT(pass["weight"].get<double>(), 0.3);
  }
  EXPECT_NEAR(json["profile"]["length_m"].get<double>(), 0.04, 0.002);
  for (const char* file : {"profile.csv", "spectrum.csv", "texture.json", "result.json"})
    EXPECT_TRUE(fs::is_regular_file(dir / "out" / file)) << file;

  const Outcome refused = run({"merge", path("a"), path("c"), "-o", path("none")});
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("did not pass over the same line"));
  EXPECT_FALSE(fs::exists(dir / "none"));

  // Results whose noise was removed are not merged.
  ASSERT_EQ(run({"process", path("a"), "-o", path("pa")}).code, 0);
  const Outcome removed = run({"merge", path("pa"), path("b"), "-o", path("none")});
  EXPECT_EQ(removed.code, 1);
  EXPECT_THAT(removed.err, HasSubstr("the noise was removed"));
  ASSERT_EQ(run({"process", path("a"), "-o", path("pa"), "--set", "profile.remove_noise=false"}).code, 0);
  const Outcome folder = run({"merge", path("pa"), path("b"), "-o", path("out2"), "--json"});
  ASSERT_EQ(folder.code, 0) << folder.err;
  EXPECT_NEAR(nlohmann::json::parse(folder.out)["roughness"]["Rq_m"].get<double>(),
              json["roughness"]["Rq_m"].get<double>(), 1e-6);

  const Outcome one = run({"merge", path("a"), "-o", path("none")});
  EXPECT_EQ(one.code, 2);
}

// A stroke and itself, however named, written or processed, are one measurement.
TEST(Merge, RefusesAStrokeWithItself) {
  const testkit::TempDir dir;
  const auto path = [&](const char* name) { return (dir / name).string(); };
  simulate_stroke(dir / "a", 1, 11);
  fs::copy(dir / "a", dir / "copy", fs::copy_options::recursive);
  std::ifstream in(dir / "copy" / "recording.json");
  auto info = nlohmann::json::parse(in);
  info["created"] = "2026-11-24T12:00:00Z";
  info["object"] = "another";
  std::ofstream(dir / "copy" / "recording.json") << info.dump();
  ASSERT_EQ(run({"process", path("copy"), "-o", path("p"), "--set", "profile.remove_noise=false"}).code, 0);
  for (const char* other : {"a", "copy", "p"}) {
    const Outcome outcome = run({"merge", path("a"), path(other), "-o", path("none")});
    EXPECT_EQ(outcome.code, 1) << other << outcome.out;
    EXPECT_THAT(outcome.err, HasSubstr("a and ")) << other;
    EXPECT_THAT(outcome.err, HasSubstr("100 % of their samples in common")) << other;
    EXPECT_FALSE(fs::exists(dir / "none"));
  }
  // Without the fingerprint, as an earlier version wrote the result, the heights give it away.
  std::ifstream result(dir / "p" / "result.json");
  auto json = nlohmann::json::parse(result);
  json.erase("fingerprint");
  std::ofstream(dir / "p" / "result.json") << json.dump();
  const Outcome merged = run({"merge", path("a"), path("p"), "-o", path("out")});
  EXPECT_EQ(merged.code, 3) << merged.out;
  EXPECT_THAT(merged.err, HasSubstr("not two measurements"));
}

// A stroke that is invalid as a scan makes no valid merge, and is named; a result that states no noise neither.
TEST(Merge, AnInvalidStrokeMakesTheMergeInvalid) {
  const testkit::TempDir dir;
  const auto path = [&](const char* name) { return (dir / name).string(); };
  simulate_stroke(dir / "a", 1, 11);
  simulate_stroke(dir / "b", 1, 12);
  ASSERT_EQ(run({"process", path("a"), "-o", path("pa"), "--set", "profile.remove_noise=false"}).code, 0);
  const auto edit = [&](auto change) {
    std::ifstream in(dir / "pa" / "result.json");
    auto json = nlohmann::json::parse(in);
    in.close();
    change(json);
    std::ofstream(dir / "pa" / "result.json") << json.dump();
  };
  edit([](auto& json) {
    json["trustworthy"] = false;
    json["verdicts"] = {{{"code", "scale_disagrees"}, {"severity", "invalid"}, {"message", "of another scale"}}};
  });
  const Outcome invalid = run({"merge", path("pa"), path("b"), "-o", path("out")});
  EXPECT_EQ(invalid.code, 3);
  EXPECT_THAT(invalid.err, HasSubstr("pa: of another scale"));
  // To be lost in noise is what strokes are merged for.
  edit([](auto& json) { json["verdicts"][0]["code"] = "below_noise"; });
  EXPECT_EQ(run({"merge", path("pa"), path("b"), "-o", path("out2")}).code, 0);
  edit([](auto& json) { json.erase("trustworthy"); });
  const Outcome unjudged = run({"merge", path("pa"), path("b"), "-o", path("out3")});
  EXPECT_EQ(unjudged.code, 3);
  EXPECT_THAT(unjudged.err, HasSubstr("states no verdict"));
}

}  // namespace
}  // namespace asperity::cli
