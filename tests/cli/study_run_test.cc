// `asperity study run` as a person at a terminal uses it, with a modelled hand that touches both textures: the keys
// come from a file, one when the trial can be answered.
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "asperity/base/csv.h"
#include "asperity/study/study_log.h"
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using testing::HasSubstr;

std::string wave(double height_m) {
  return R"({"format":"asperity-texture","version":1,"name":"wave","model":"fourier1d","fourier1d":{"length_mm":10,)"
         R"("omega_rad_per_mm":0.6283185307179586,"a_m":[0,0,0,)" +
         std::to_string(height_m) + R"(],"b_m":[0,0,0,0],"mean_m":0},"compliance_kc":1,"extra":{}})";
}

// On a machine that is too busy for a servo the answers are kept all the same, and the verdict states why it was late.
bool has_run(const Outcome& outcome) {
  return outcome.code == 0 || (outcome.code == 3 && outcome.err.find("invalid: ") != std::string::npos);
}

class StudyRun : public testing::Test {
 protected:
  void SetUp() override {
    write_text(dir_ / "low.texture.json", wave(1e-5));
    write_text(dir_ / "high.texture.json", wave(1e-4));
  }

  // Two trials: each texture once on each side.
  Json study() const {
    return {{"format", "asperity.study"},
            {"version", 1},
            {"name", "waves"},
            {"stimuli", {"low.texture.json", "high.texture.json"}},
            {"presentation", {{"device", "sim"}, {"tile_mm", 10.0}}}};
  }

  Outcome ask(const Json& study, const std::string& keys, std::vector<std::string> more = {"--participant", "p01"}) {
    write_text(dir_ / "waves.study.json", study.dump());
    return ask_file("waves.study.json", keys, std::move(more));
  }
  Outcome ask_file(const std::string& file, const std::string& keys, std::vector<std::string> more = {}) {
    write_text(dir_ / "keys", keys);
    more.insert(more.begin(), {"study", "run", (dir_ / file).string(), "--json", "--set", "servo.priority=ignore"});
    return run_from(dir_ / "keys", more);
  }
  StudyLog log(const std::string& file = "waves_p01.study.csv") const {
    return parse_study_log(read_file(dir_ / file, kLargestStudyLog_bytes), file);
  }

  const testkit::TempDir dir_;
};

TEST_F(StudyRun, KeepsEachAnswerWithItsTouches) {
  const Outcome outcome = ask(study(), "1\n2\n");
  ASSERT_TRUE(has_run(outcome)) << outcome.err;
  const Json said = Json::parse(outcome.out);
  EXPECT_EQ(said["answers"], 2);
  EXPECT_EQ(said["finished"], true);
  const StudyLog kept = log();
  ASSERT_EQ(kept.session.answers().size(), 2U);
  EXPECT_FALSE(kept.session.trial());
  EXPECT_EQ(kept.textures_crc32.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const StudyAnswer& answer = kept.session.answers()[k];
    EXPECT_EQ(answer.value, static_cast<int>(k));
    // No force for 0.3 s, then both tiles for 0.2 s each.
    EXPECT_GE(answer.response_s, 0.4);
    EXPECT_GE(answer.since_begin_s, answer.response_s + 0.25);
    for (const TileTouch& touch : answer.touches) {
      EXPECT_GE(touch.touch_s, 0.2);
      EXPECT_GE(touch.force_N, 0.1);  // what counts as touching
      EXPECT_LE(touch.force_N, 5.0);  // the safety layer's limit
    }
  }
  EXPECT_EQ(run({"study", "summarize", (dir_ / "waves_p01.study.csv").string(), "--quiet"}).err.find("not the log"),
            std::string::npos);
}

TEST_F(StudyRun, GoesOnWithALogAndOverwritesNone) {
  const Outcome first = ask(study(), "1");
  ASSERT_TRUE(has_run(first)) << first.err;
  EXPECT_EQ(Json::parse(first.out)["finished"], false);
  EXPECT_EQ(log().session.answers().size(), 1U);
  const Outcome other = ask(study(), "1");
  ASSERT_TRUE(has_run(other)) << other.err;
  EXPECT_EQ(log("waves_p01_2.study.csv").session.answers().size(), 1U);
  const double before_s = log().since_begin_s;
  const Outcome second = ask_file("waves_p01.study.csv", "2");
  ASSERT_TRUE(has_run(second)) << second.err;
  EXPECT_EQ(Json::parse(second.out)["finished"], true);
  EXPECT_EQ(log().session.answers().size(), 2U);
  EXPECT_GT(log().since_begin_s, before_s);
  const Outcome third = ask_file("waves_p01.study.csv", "1");
  EXPECT_EQ(third.code, 1);
  EXPECT_THAT(third.err, HasSubstr("all trials are answered"));
}

TEST_F(StudyRun, DoesNotGoOnWithOtherTextures) {
  ASSERT_TRUE(has_run(ask(study(), "1")));
  const std::string before = read_file(dir_ / "waves_p01.study.csv", kLargestStudyLog_bytes);
  write_text(dir_ / "low.texture.json", wave(2e-5));
  const Outcome outcome = ask_file("waves_p01.study.csv", "2");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("low.texture.json has changed since this session began"));
  EXPECT_EQ(read_file(dir_ / "waves_p01.study.csv", kLargestStudyLog_bytes), before);
}

TEST_F(StudyRun, AnAnswerCanBeWithdrawnAndAPauseTaken) {
  const Outcome outcome = ask(study(), "1up 22");
  ASSERT_TRUE(has_run(outcome)) << outcome.err;
  ASSERT_EQ(log().session.answers().size(), 2U);
  EXPECT_EQ(log().session.answers().front().value, 1);
  EXPECT_THAT(read_file(dir_ / "waves_p01.study.csv", kLargestStudyLog_bytes), HasSubstr("\ntaken_back,1,"));
}

TEST_F(StudyRun, RatingsAreNumbers) {
  Json rating = study();
  rating["method"] = "rating";
  const Outcome outcome = ask(rating,
                              "9"
                              "73");  // 9 is none
  ASSERT_TRUE(has_run(outcome)) << outcome.err;
  ASSERT_EQ(log().session.answers().size(), 2U);
  EXPECT_EQ(log().session.answers()[0].value, 7);
  EXPECT_EQ(log().session.answers()[1].value, 3);
}

TEST_F(StudyRun, NothingBeginsWithoutConsent) {
  Json asked = study();
  asked["consent"] = "You may stop at any time.";
  for (const char* keys : {"n", ""}) {
    const Outcome outcome = ask(asked, keys);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("You may stop at any time."));
    EXPECT_THAT(outcome.err, HasSubstr("the participant has not agreed"));
  }
  EXPECT_FALSE(fs::exists(dir_ / "waves_p01.study.csv"));
  EXPECT_TRUE(has_run(ask(asked, "y1")));
  EXPECT_EQ(log().session.answers().size(), 1U);
  EXPECT_TRUE(has_run(ask(asked, "12", {"--participant", "p02", "--consented"})));
}

TEST_F(StudyRun, RefusesWhatItCannotRun) {
  const Outcome nobody = ask(study(), "1", {});
  EXPECT_EQ(nobody.code, 2);
  EXPECT_THAT(nobody.err, HasSubstr("--participant"));
  Json mouse = study();
  mouse["presentation"]["device"] = "mouse";
  const Outcome only_studio = ask(mouse, "1");
  EXPECT_EQ(only_studio.code, 2);
  EXPECT_THAT(only_studio.err, HasSubstr("asperity studio"));
  EXPECT_TRUE(has_run(ask(mouse, "12", {"--participant", "p03", "--device", "sim"})));
  for (const char* code : {"../p01", "p 01", ""}) {
    EXPECT_NE(ask(study(), "1", {"--participant", code}).code, 0) << code;
  }
  // A study's names stay in its folder.
  fs::create_directories(dir_ / "inner");
  Json outside = study();
  outside["stimuli"] = {"../low.texture.json", "../high.texture.json"};
  write_text(dir_ / "inner" / "waves.study.json", outside.dump());
  const Outcome climbed = ask_file("inner/waves.study.json", "1", {"--participant", "p04"});
  EXPECT_EQ(climbed.code, 1);
  EXPECT_THAT(climbed.err, HasSubstr("is not in the folder of the study"));
  Json missing = study();
  missing["stimuli"] = {"low.texture.json", "none.texture.json"};
  const Outcome absent = ask(missing, "1");
  EXPECT_EQ(absent.code, 1);
  EXPECT_THAT(absent.err, HasSubstr("none.texture.json"));
  EXPECT_FALSE(fs::exists(dir_ / "waves_p01.study.csv"));
}

}  // namespace
}  // namespace asperity::cli
