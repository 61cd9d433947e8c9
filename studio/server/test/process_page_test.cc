#include "process/process_page.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "asperity/base/output.h"
#include "asperity/json/parse_json.h"
#include "asperity/pipeline/measure_repeatability.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/recording/cut_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/simulation/simulate_recording.h"
#include "page_rig.h"
#include "process/process_choice.h"
#include "process/scan_sessions.h"
#include "read_block.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream out;
  out << stream.rdbuf();
  return out.str();
}

Recording simulated(int seed) {
  SimulationConfig config = make_simulation_config("protoboard", "what");
  config.hand.length_m = 0.04;
  config.seed = seed;
  return simulate_recording(config);
}

void store(const fs::path& folder, const Recording& recording) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  write_recording(folder, recording);
}

class ProcessPageTest : public ::testing::Test, protected PageRig<> {
 protected:
  ProcessPageTest() {
    store(folder / "one", simulated(1));
    store(folder / "two", simulated(2));
    open(make_process_page(shared));
  }

  void choose(std::initializer_list<const char*> recordings) {
    Json scans = Json::array();
    for (const char* recording : recordings) scans.push_back({{"recording", recording}, {"segment", ""}});
    document.edit("/process/scans", scans, "choose");
  }
};

TEST_F(ProcessPageTest, RunsWithTheSettingsOfTheDocument) {
  const FakeHub::Answer before = call("process.run", Json{{"recording", "one"}});
  ASSERT_EQ(before.error, "");
  const Json first = ReadBlock(before.block).head;
  EXPECT_EQ(first["kind"], "measured");
  EXPECT_EQ(first["scan"]["recording"], "one");
  EXPECT_EQ(first["result"]["config"]["profile"]["cutoff_cycles_per_mm"], 0.1);

  document.edit("/process/config/profile.cutoff_cycles_per_mm", "0.3", "tune");
  const Json second = ReadBlock(call("process.run", Json{{"recording", "one"}}).block).head;
  // The oracle is the command line's own way.
  ProcessConfig config;
  config.profile.cutoff_cycles_per_mm = 0.3;
  const Recording recording = read_recording(folder / "one");
  const Json expected = parse_json(format_result(process_recording(recording, config), recording, "one"));
  EXPECT_EQ(second["result"], expected);
}

TEST_F(ProcessPageTest, TellsItsFieldsWithValuesAndDefaults) {
  document.edit("/process/config/method", "thesis", "method");
  const Json fields = call("process.fields").result["fields"];
  EXPECT_GT(fields.size(), 60U);
  const auto method = std::find_if(fields.begin(), fields.end(), [](const Json& f) { return f["path"] == "method"; });
  ASSERT_NE(method, fields.end());
  EXPECT_EQ((*method)["value"], "thesis");
  EXPECT_EQ((*method)["default"], "fused");
  EXPECT_EQ((*method)["choices"], parse_json(R"(["fused","thesis","thesis_tuned","raw","ekf","particle"])"));
}

TEST_F(ProcessPageTest, RefusesWhatIsNoSettingAndChangesNothing) {
  const Json before = document.section("process");
  for (const char* edit :
       {R"(["/process/config/profile.cutof", "0.3"])", R"(["/process/config/method", "magic"])",
        R"(["/process/config/profile.spacing_m", "-1"])", R"(["/process/config/profile.spacing_m", 1])",
        R"(["/process/config", []])", R"(["/process/current", -1])", R"(["/process/current", "a"])",
        R"(["/process/scans", {}])", R"(["/process/scans", [{"segment": ""}]])"}) {
    const Json json = parse_json(edit);
    EXPECT_THROW(document.edit(json[0].get<std::string>(), json[1], "bad"), Error) << edit;
    EXPECT_EQ(document.section("process"), before) << edit;
  }
  Json many = Json::array();
  for (std::size_t i = 0; i <= kMostScans; ++i) many.push_back({{"recording", std::to_string(i)}, {"segment", ""}});
  EXPECT_THROW(document.edit("/process/scans", many, "too many"), Error);
}

TEST_F(ProcessPageTest, ANewerSettingTakesThePlaceOfOneThatWaits) {
  const std::uint64_t keeps_busy = begin("process.run", Json{{"recording", "two"}});
  const std::uint64_t older = begin("process.run", Json{{"recording", "one"}});
  document.edit("/process/config/profile.cutoff_cycles_per_mm", "0.2", "tune");
  const std::uint64_t newer = begin("process.run", Json{{"recording", "one"}});
  EXPECT_EQ(answer_to(older).error, "cancelled");
  EXPECT_EQ(answer_to(keeps_busy).error, "");
  EXPECT_EQ(ReadBlock(answer_to(newer).block).head["result"]["config"]["profile"]["cutoff_cycles_per_mm"], 0.2);
}

TEST_F(ProcessPageTest, ComparesScansOfTheSameSurface) {
  EXPECT_THAT(call("process.compare").error, ::testing::HasSubstr("nothing to compare"));
  choose({"one", "two"});
  const FakeHub::Answer answer = call("process.compare");
  ASSERT_EQ(answer.error, "");
  const ReadBlock block(answer.block);
  ASSERT_EQ(block.head["scans"].size(), 2U);
  EXPECT_NEAR(block.head["scans"][0]["correlation"].get<double>(), 1.0, 1e-9);
  std::vector<RepeatedScan> scans;
  for (const char* name : {"one", "two"}) {
    const Recording recording = read_recording(folder / name);
    scans.push_back(repeated_scan(process_recording(recording, {}), recording));
  }
  const Repeatability expected = measure_repeatability(scans, {});
  EXPECT_EQ(block.head["scans"][1]["correlation"].get<double>(), expected.with_first[1].correlation);
  // One not found to be periodic has no pitch.
  const Json& pitch_m = block.head["scans"][1]["pitch_m"];
  ASSERT_EQ(pitch_m.is_null(), !scans[1].periodicity.periodic) << pitch_m.dump();
  if (scans[1].periodicity.periodic) {
    EXPECT_EQ(pitch_m.get<double>(), scans[1].periodicity.pitch_m);
  }
  EXPECT_EQ(block.head["figures"][0]["value"].get<double>(), expected.correlation.mean);
  const std::size_t points = block.array<double>("s_m").size();
  EXPECT_EQ(block.array<float>("height_m").size(), 2 * points);
  EXPECT_EQ(block.array<float>("high_m").size(), points);
}

TEST_F(ProcessPageTest, WritesTheFilesOfTheCommandLine) {
  choose({"one"});
  document.edit("/process/config/profile.cutoff_cycles_per_mm", "0.3", "tune");
  const FakeHub::Answer answer = call("process.write", Json{{"name", "out"}});
  ASSERT_EQ(answer.error, "");
  EXPECT_EQ(answer.result["files"], parse_json(R"([""])"));
  ProcessConfig config;
  config.profile.cutoff_cycles_per_mm = 0.3;
  const Recording recording = read_recording(folder / "one");
  const ProcessResult result = process_recording(recording, config);
  fs::create_directories(folder / "expected");
  write_result(folder / "expected", result, recording, "one");
  for (const char* file : {"result.json", "profile.csv", "trajectory.csv", "texture.json"}) {
    ASSERT_FALSE(content(folder / "expected" / file).empty()) << file;
    EXPECT_TRUE(content(folder / "out" / file) == content(folder / "expected" / file)) << file;
  }
  // Again, over its own results; several, each in a folder; never over something else.
  choose({"one", "two"});
  EXPECT_EQ(call("process.write", Json{{"name", "out"}, {"replace", true}}).result["files"],
            parse_json(R"(["one","two"])"));
  EXPECT_TRUE(fs::exists(folder / "out" / "two" / "result.json"));
  EXPECT_FALSE(fs::exists(folder / "out" / "result.json"));
  EXPECT_NE(call("process.write", Json{{"name", "one"}}).error, "");
  EXPECT_TRUE(fs::exists(folder / "one" / "recording.json"));
  EXPECT_NE(call("process.write", Json{{"name", "../out"}}).error, "");
}

TEST_F(ProcessPageTest, HandsOutTheReportOfAResult) {
  fs::create_directories(folder / "out");
  write_file(folder / "out" / "report.html", "<!doctype html>");
  const ReadBlock block(call("process.report", Json{{"folder", "out"}}).block);
  const auto html = block.array<std::uint8_t>("page");
  EXPECT_EQ(std::string(html.begin(), html.end()), "<!doctype html>");
  for (const char* other : {"one", "..", "../out", "/etc", ""})
    EXPECT_NE(call("process.report", Json{{"folder", other}}).error, "") << other;
}

TEST_F(ProcessPageTest, WhatCannotBeReadIsRefusedInWords) {
  EXPECT_NE(call("process.run", Json{{"recording", "three"}}).error, "");
  EXPECT_NE(call("process.run", Json{{"recording", "../one"}}).error, "");
  EXPECT_NE(call("process.run").error, "");
  EXPECT_THAT(call("process.run", Json{{"recording", "one"}, {"segment", "third"}}).error,
              ::testing::HasSubstr("no segment 'third'"));
  std::ofstream(folder / "two" / "probe.csv") << "nonsense\n";
  EXPECT_THAT(call("process.run", Json{{"recording", "two"}}).error, ::testing::HasSubstr("probe.csv"));
}

TEST(ScanSessions, ReadsAgainWhatHasChangedAndKeepsTheLastUsed) {
  const testkit::TempDir folder;
  store(folder / "a", simulated(1));
  ScanSessions sessions;
  OpenScan* const first = &sessions.open(folder / "a", "");
  EXPECT_EQ(&sessions.open(folder / "a", ""), first);
  const std::size_t before = first->session.recording().tracker.size();
  Recording shorter = simulated(1);
  shorter = cut_recording(shorter, shorter.probe.t_ns.front(), shorter.tracker.t_ns.end()[-2]);
  store(folder / "a", shorter);
  EXPECT_EQ(sessions.open(folder / "a", "").session.recording().tracker.size(), before - 1);
}

TEST(ScanSessions, SegmentsThatStandApartAreScansOfTheirOwn) {
  const testkit::TempDir folder;
  Recording recording = simulated(1);
  const std::int64_t start_ns = recording.probe.t_ns.front(), span_ns = recording.probe.t_ns.back() - start_ns;
  recording.info.segments = {{"down", start_ns, start_ns + span_ns / 3},
                             {"up", start_ns + span_ns / 2, start_ns + span_ns}};
  store(folder / "a", recording);
  ScanSessions sessions;
  EXPECT_EQ(sessions.open(folder / "a", "").segment, "down");
  OpenScan& up = sessions.open(folder / "a", "up");
  EXPECT_EQ(up.segments, (std::vector<std::string>{"down", "up"}));
  EXPECT_GE(up.session.recording().probe.t_ns.front(), start_ns + span_ns / 2);
}

}  // namespace
}  // namespace asperity::studio
