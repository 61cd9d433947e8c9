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

// A stroke of 50 mm over sandpaper, along one guide.
void simulate_stroke(const fs::path& folder, int seed) {
  const Outcome outcome =
      run({"simulate", "--surface", "sandpaper", "--seed", std::to_string(seed), "--set", "hand.length_m=0.05", "--set",
           "surface.seed=1", "--set", "hand.path_seed=1", "-o", folder.string()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
}

// The second half of a recording's rows, without the checksums of the whole.
void write_half(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const char* name : {"recording.json", "calibration.json"}) fs::copy_file(from / name, to / name);
  for (const char* name : {"probe.csv", "tracker.csv"}) {
    std::ifstream in(from / name);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    std::ofstream out(to / name);
    out << lines.front() << "\n";
    for (std::size_t i = lines.size() / 2; i < lines.size(); ++i) out << lines[i] << "\n";
  }
}

TEST(Realism, AHeldBackStrokeIsComparedAndAnOwnOneRefused) {
  const testkit::TempDir dir;
  for (const int seed : {1, 2, 3}) simulate_stroke(dir / ("s" + std::to_string(seed)), seed);
  const auto path = [&](const char* name) { return (dir / name).string(); };
  ASSERT_EQ(run({"merge", path("s1"), path("s2"), "-o", path("made")}).code, 0);

  const std::vector<std::string> stiff{"--stiffness", "200000", "--friction", "0.18"};
  const auto realism = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "realism");
    words.insert(words.end(), stiff.begin(), stiff.end());
    return run(words);
  };
  const Outcome held = realism({path("made"), "--stroke", path("s3"), "--json", "-o", path("out")});
  ASSERT_EQ(held.code, 0) << held.err;
  const auto json = nlohmann::json::parse(held.out);
  EXPECT_EQ(json["format"], "asperity-realism");
  EXPECT_FALSE(json["self_test"].get<bool>());
  EXPECT_EQ(json["made_from"].size(), 2u);
  // Above what noise may have. Without another stroke the bands of the hand's tremor count too.
  EXPECT_GT(json["score"].get<double>(), 0.3);
  EXPECT_TRUE(json["ceiling"].is_null());
  EXPECT_TRUE(json["alignment"]["found"].get<bool>());
  EXPECT_TRUE(fs::is_regular_file(dir / "out/result.json"));

  // The same bytes again.
  EXPECT_EQ(realism({path("made"), "--stroke", path("s3"), "--json"}).out, held.out);

  // A stroke that the texture was made from, also under another name.
  fs::copy(dir / "s1", dir / "renamed", fs::copy_options::recursive);
  for (const char* own : {"s1", "renamed"}) {
    const Outcome refused = realism({path("made"), "--stroke", path(own)});
    EXPECT_EQ(refused.code, 1) << own;
    EXPECT_THAT(refused.err, HasSubstr("was made from this recording or a part of it")) << own;
  }
  // Nor its second half.
  ASSERT_EQ(run({"process", path("s1"), "-o", path("single")}).code, 0);
  write_half(dir / "s1", dir / "half");
  const Outcome half = realism({path("single"), "--stroke", path("half")});
  EXPECT_EQ(half.code, 1);
  EXPECT_THAT(half.err, HasSubstr("was made from this recording or a part of it"));
  // Nor a texture that was fitted to its heights.
  ASSERT_EQ(run({"texture", "fit", path("single") + "/profile.csv", "-o", path("fitted.texture.json")}).code, 0);
  const Outcome fitted = realism({path("fitted.texture.json"), "--stroke", path("s1")});
  EXPECT_EQ(fitted.code, 1);
  EXPECT_THAT(fitted.err, HasSubstr("was made from this recording or a part of it"));
  const Outcome allowed = realism({path("made"), "--stroke", path("s1"), "--allow-own", "--json"});
  ASSERT_EQ(allowed.code, 0) << allowed.err;
  EXPECT_TRUE(nlohmann::json::parse(allowed.out)["self_test"].get<bool>());
  EXPECT_THAT(allowed.err, HasSubstr("made from this stroke"));

  // Another real stroke is the ceiling; the held-back one is none.
  ASSERT_EQ(run({"process", path("s1"), "-o", path("one")}).code, 0);
  const Outcome with = realism({path("one"), "--stroke", path("s3"), "--with", path("s2"), "--json"});
  ASSERT_EQ(with.code, 0) << with.err;
  EXPECT_GT(nlohmann::json::parse(with.out)["ceiling"].get<double>(), 0.6);
  const Outcome itself = realism({path("one"), "--stroke", path("s3"), "--with", path("s3")});
  EXPECT_EQ(itself.code, 1);
  EXPECT_THAT(itself.err, HasSubstr("one measurement and not two"));

  // A spring of 1 N/mm, the renderer's usual one, is not this surface's.
  const Outcome soft = run({"realism", path("made"), "--stroke", path("s3"), "--json"});
  EXPECT_LT(nlohmann::json::parse(soft.out)["score"].get<double>(), 0.5);

  const Outcome nothing = realism({path("s1"), "--stroke", path("s3")});
  EXPECT_EQ(nothing.code, 1);
  EXPECT_THAT(nothing.err, HasSubstr("neither scene.json nor profile.csv"));
}

}  // namespace
}  // namespace asperity::cli
