// A study that continues after a restart, its logs and its results' names.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "asperity/json/parse_json.h"
#include "asperity/texture/read_height_image.h"
#include "asperity/texture/texture_file.h"
#include "study_page_fixture.h"

namespace asperity::studio {
namespace {

using testing::HasSubstr;

std::string crc_by_bits(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  char text[9];
  std::snprintf(text, sizeof text, "%08x", ~crc);
  return text;
}

TEST_F(StudyPageTest, GoesOnAfterARestart) {
  {
    StudyRig rig(folder.path());
    rig.set_up("pairs", 3);
    ASSERT_EQ(rig.ask("study.begin").error, "");
    rig.touch();
    EXPECT_EQ(rig.answer(1).error, "");
    EXPECT_EQ(rig.answer(0).error, "");
  }
  std::ofstream(folder / "study_p01.study.csv", std::ios::app) << "answer,3,1,";
  StudyRig rig(folder.path());
  EXPECT_TRUE(rig.pump([&] { return rig.status()["phase"] == "paused"; }));
  EXPECT_EQ(rig.status()["why"], "restart");
  EXPECT_THAT(rig.status()["problem"].get<std::string>(), HasSubstr("cut off"));
  EXPECT_EQ(rig.session()["trial"], 3);
  EXPECT_EQ(rig.ask("study.resume").error, "");
  rig.touch();
  for (int trial = 3; trial <= 6; ++trial) EXPECT_EQ(rig.answer(1).error, "");
  EXPECT_EQ(rig.status()["phase"], "finished");
  EXPECT_EQ(rig.ask("study.end").error, "");
  EXPECT_EQ(rig.ask("study.results", {{"log", "study_p01.study.csv"}}).result["answers"], 6);
}

TEST_F(StudyPageTest, GoesOnWithTheTexturesItBeganWithAlone) {
  const std::string before = read_file(folder / "tile1.pgm", 1 << 20U);
  {
    StudyRig rig(folder.path());
    rig.set_up("pairs", 2);
    ASSERT_EQ(rig.ask("study.begin").error, "");
    rig.touch();
    EXPECT_EQ(rig.answer(1).error, "");
  }
  // Of the same length, as an image always is.
  std::string after = before;
  after.back() = static_cast<char>(after.back() + 1);
  std::ofstream(folder / "tile1.pgm", std::ios::binary) << after;
  const std::string rows = log();
  StudyRig rig(folder.path());
  EXPECT_TRUE(rig.pump([&] { return rig.status()["problem"] != ""; }));
  EXPECT_EQ(rig.status()["problem"], "tile1.pgm has changed since this session began");
  EXPECT_EQ(rig.status()["phase"], "none");
  const FakeHub::Answer refused = rig.ask("study.continue", {{"log", "study_p01.study.csv"}});
  EXPECT_EQ(refused.error, "tile1.pgm has changed since this session began");
  EXPECT_THAT(refused.hint, HasSubstr("Restore what has changed and continue, or begin a new session."));
  EXPECT_EQ(log(), rows);
  std::ofstream(folder / "tile1.pgm", std::ios::binary) << before;
  EXPECT_EQ(rig.ask("study.continue", {{"log", "study_p01.study.csv"}}).error, "");
  EXPECT_EQ(rig.session()["trial"], 2);
}

TEST_F(StudyPageTest, KnowsAChangeOfWhatATextureNames) {
  Texture texture = read_height_image(folder / "tile0.pgm");
  write_texture(folder / "a.texture.json", texture);
  write_texture(folder / "b.texture.json", texture);
  StudyRig rig(folder.path());
  rig.set_up("rating", 0);
  rig.document.edit("/study/study/stimuli", Json::array({"a.texture.json", "b.texture.json", "tile0.pgm"}), "textures");
  ASSERT_EQ(rig.ask("study.begin").error, "");
  EXPECT_EQ(rig.ask("study.end").error, "");
  // The check sums of the head, by the definition of CRC-32/ISO-HDLC bit by bit.
  const Json head = parse_json(log().substr(log().find('{'), log().find('\n') - log().find('{')));
  const std::string whole =
      read_file(folder / "a.texture.json", 1 << 20U) + read_file(folder / "a.heights.png", 1 << 20U);
  EXPECT_EQ(head["textures_crc32"]["a.texture.json"], crc_by_bits(whole));
  EXPECT_EQ(head["textures_crc32"]["tile0.pgm"], crc_by_bits(read_file(folder / "tile0.pgm", 1 << 20U)));
  std::get<HeightMap>(texture.model).level.front() += 1;
  testkit::TempDir other;
  write_texture(other / "a.texture.json", texture);
  std::filesystem::copy_file(other / "a.heights.png", folder / "a.heights.png",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(rig.ask("study.continue", {{"log", "study_p01.study.csv"}}).error,
            "a.texture.json has changed since this session began");
  std::filesystem::resize_file(folder / "tile0.pgm", 0);
  std::ofstream(folder / "tile0.pgm", std::ios::binary) << read_file(folder / "tile1.pgm", 1 << 20U);
  EXPECT_EQ(rig.ask("study.continue", {{"log", "study_p01.study.csv"}}).error,
            "a.texture.json, tile0.pgm have changed since this session began");
}

TEST_F(StudyPageTest, NamesResultsAfterTheRun) {
  std::filesystem::create_directory(folder / "kept");
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  const auto written = [&](const std::string& name) {
    return rig.ask("study.export", {{"log", name}}).result["name"].get<std::string>();
  };
  const auto results = [&](const std::string& name) { return parse_json(read_file(folder / name, 1 << 20U)); };
  for (int run = 1; run <= 2; ++run) {
    ASSERT_EQ(rig.ask("study.begin").error, "");
    EXPECT_EQ(rig.ask("study.end").error, "");
  }
  // The same twice is one file; that of the second run is another's name.
  EXPECT_EQ(written("study_p01.study.csv"), "study_p01.results.json");
  EXPECT_EQ(written("./study_p01.study.csv"), "study_p01.results.json");
  EXPECT_FALSE(std::filesystem::exists(folder / "study_p01_2.results.json"));
  EXPECT_EQ(written("study_p01_2.study.csv"), "study_p01_2.results.json");
  EXPECT_EQ(results("study_p01.results.json")["run"], 1);
  EXPECT_EQ(results("study_p01_2.results.json")["run"], 2);
  // Other results of the same run are written next to the first, which stay.
  EXPECT_EQ(rig.ask("study.continue", {{"log", "study_p01.study.csv"}}).error, "");
  EXPECT_EQ(rig.ask("study.resume").error, "");
  rig.touch();
  EXPECT_EQ(rig.answer(1).error, "");
  EXPECT_EQ(rig.ask("study.end").error, "");
  EXPECT_EQ(written("study_p01.study.csv"), "study_p01.results_2.json");
  EXPECT_EQ(written("study_p01.study.csv"), "study_p01.results_2.json");
  EXPECT_EQ(results("study_p01.results.json")["answers"], 0);
  EXPECT_EQ(results("study_p01.results_2.json")["answers"], 1);
  EXPECT_EQ(results("study_p01.results_2.json")["run"], 1);
  // Next to the log.
  std::filesystem::rename(folder / "study_p01.study.csv", folder / "kept" / "study_p01.study.csv");
  EXPECT_EQ(written("kept/study_p01.study.csv"), "kept/study_p01.results.json");
}

TEST_F(StudyPageTest, LeavesNoLogOfASessionThatCouldNotBegin) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  // A folder that is not empty is where the log in hand would be named.
  std::filesystem::create_directories(folder / ".asperity-study.json" / "inner");
  EXPECT_NE(rig.ask("study.begin").error, "");
  EXPECT_FALSE(std::filesystem::exists(folder / "study_p01.study.csv"));
  EXPECT_EQ(rig.status()["phase"], "none");
}

TEST_F(StudyPageTest, GoesOnWithNoLogThatHasNoWholeColumns) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  ASSERT_EQ(rig.ask("study.begin").error, "");
  EXPECT_EQ(rig.ask("study.end").error, "");
  const std::string head = log();
  std::ofstream(folder / "study_p01.study.csv") << head.substr(0, head.size() - 1);
  EXPECT_THAT(rig.ask("study.continue", {{"log", "study_p01.study.csv"}}).error, HasSubstr("cut off"));
  EXPECT_EQ(log() + '\n', head);
}
}  // namespace
}  // namespace asperity::studio
