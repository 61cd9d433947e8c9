#include "align/align_run.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "align/scan_overlaps.h"
#include "align_bench.h"
#include "asperity/base/csv.h"
#include "asperity/json/parse_json.h"
#include "asperity/pipeline/register_config.h"
#include "asperity/pipeline/write_registration.h"
#include "asperity/session/register_input.h"

namespace asperity::studio {
namespace {

using testing::HasSubstr;

class AlignRunTest : public ::testing::Test {
 protected:
  AlignRunTest() { bench_.call("align.open"); }

  AlignBench bench_;
};

// 500 points with 10 µm of noise determine the pose to about 10 µm / sqrt(500) times a few, and facets of 1.5 mm
// are met to a tenth of that noise: 50 µm is far, and 5 mm is where it began.
constexpr double kReached_m = 50e-6;

TEST_F(AlignRunTest, ReachesTheTruthAndTellsEveryIteration) {
  ASSERT_GT(bench_.error_m(bench_.pose()), 4e-3);
  const Json result = bench_.call("align.run", args_of({{"guess", true}})).result;
  ASSERT_TRUE(result.is_object());
  EXPECT_LT(bench_.error_m(pose_of_json(result["T_mesh_world"], "")), kReached_m);
  EXPECT_THAT(result["verdict"].get<std::string>(), HasSubstr("converged"));
  EXPECT_THAT(result["certainty"].get<std::string>(), HasSubstr("known to"));
  EXPECT_TRUE(result["trustworthy"].get<bool>()) << result["verdict"];
  EXPECT_EQ(bench_.hub.events("align.result").back(), result);
  EXPECT_EQ(bench_.call("align.result").result, result);

  std::size_t count = 0;
  std::uint64_t sequence = 0;
  std::set<int> phases;
  for (const std::string& frame : bench_.hub.frames("align.iteration")) {
    const ReadBlock block(frame);
    EXPECT_EQ(block.head.at("topic"), "align.iteration");
    EXPECT_EQ(block.head.at("first").get<std::size_t>(), count);
    EXPECT_EQ(block.head.at("sequence").get<std::uint64_t>(), sequence++);
    for (const std::uint8_t phase : block.array<std::uint8_t>("phase")) phases.insert(phase);
    count += block.array<double>("rms_m").size();
  }
  EXPECT_GE(static_cast<int>(count), result["iterations"].get<int>());
  EXPECT_TRUE(phases.contains(static_cast<int>(RegistrationPhase::kAnnealing)));
  EXPECT_TRUE(phases.contains(static_cast<int>(RegistrationPhase::kFit)));
  EXPECT_TRUE(phases.contains(static_cast<int>(RegistrationPhase::kRefinement)));
  const ReadBlock all(bench_.call("align.iterations").block);
  EXPECT_EQ(all.array<double>("rms_m").size(), count);
  const std::vector<double> poses = all.array<double>("T_mesh_world");
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(poses[k], bench_.pose().translation_m[static_cast<int>(k)], 1e-12);
}

TEST_F(AlignRunTest, TakenItIsOneStepAndWrittenAsTheCommandLineWrites) {
  const Json before = bench_.document.section("align");
  EXPECT_THAT(bench_.call("align.accept", args_of({{"solution", "best"}})).hint, HasSubstr("Register first"));
  const Json result = bench_.call("align.run", args_of({{"guess", true}})).result;
  const Json ran = bench_.document.section("align");
  bench_.call("align.accept", args_of({{"solution", "best"}}));
  EXPECT_EQ(bench_.document.section("align").at("T_mesh_world"), result["T_mesh_world"]);
  EXPECT_EQ(bench_.document.section("align").at("ran"), ran.at("ran"));
  EXPECT_EQ(bench_.call("align.result").result, result);
  bench_.document.undo();
  EXPECT_EQ(bench_.document.section("align"), ran);
  bench_.document.redo();

  const FakeHub::Answer written = bench_.call("align.write", args_of({{"name", "laid"}}));
  ASSERT_EQ(written.error, "");
  EXPECT_EQ(written.result["scene"], "laid/scene.json");
  EXPECT_EQ(written.result["T_mesh_world"], result["T_mesh_world"]);
  EXPECT_THAT(written.result["command"].get<std::string>(),
              HasSubstr("asperity register 'path.csv' 'pebble.obj' --mesh-unit 'mm' --guess="));

  // The same through the functions of `asperity register`.
  const std::filesystem::path other = bench_.folder / "other";
  std::filesystem::create_directory(other);
  const RegisterInput input =
      read_register_input({(bench_.folder / "path.csv").string()}, (bench_.folder / "pebble.obj").string(), 1e-3, {});
  const Pose guess = pose_of_json(json_of_pose(pose_of_json(before["T_mesh_world"], "")), "");
  RegisterConfig config;
  config.placement.mode = PlacementMode::kSame;  // as on the page
  write_registration(other, register_input(input, guess, config), input.scans, input.onto);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(other)) {
    if (entry.is_directory()) continue;
    const auto name = std::filesystem::relative(entry.path(), other);
    EXPECT_EQ(read_file(entry.path(), 1U << 30U), read_file(bench_.folder / "laid" / name, 1U << 30U)) << name;
    ++files;
  }
  EXPECT_GE(files, 4U);
}

TEST_F(AlignRunTest, AScanIsAddedToASceneAndListedWithItsPose) {
  EXPECT_THAT(bench_.call("align.write", args_of({{"into", true}})).hint, HasSubstr("Choose a scene.json"));
  ASSERT_EQ(bench_.call("align.write", args_of({{"name", "laid"}})).error, "");
  bench_.write_path("second.csv", 5);
  bench_.document.edit("/align/paths", {"second.csv"}, "");
  bench_.document.edit("/align/mesh", "laid/scene.json", "");
  const ReadBlock opened(bench_.call("align.open").block);
  ASSERT_EQ(opened.head.at("stored").size(), 1U);
  EXPECT_EQ(opened.head.at("stored")[0].at("name"), "path");
  EXPECT_EQ(opened.head.at("stored")[0].at("T_mesh_world").size(), 7U);
  EXPECT_GT(opened.array<std::uint32_t>("laid_triangle").size(), 100U);
  EXPECT_TRUE(opened.array<std::uint32_t>("covered_triangle").empty());
  // It would overlap the texture of the first, which itself would be replaced and is not an overlap.
  const auto on_texture = [&] {
    const Json pose = json_of_pose(bench_.T_mesh_world);
    const ReadBlock block(bench_.call("align.residuals", args_of({{"pose", pose}})).block);
    const std::vector<std::uint8_t> overlap = block.array<std::uint8_t>("overlap");
    return static_cast<double>(std::count(overlap.begin(), overlap.end(), kOnTexture)) /
           static_cast<double>(overlap.size());
  };
  EXPECT_GT(on_texture(), 0.9);
  bench_.document.edit("/align/paths", {"path.csv"}, "");
  ASSERT_EQ(bench_.call("align.open").error, "");
  EXPECT_EQ(on_texture(), 0.0);
  bench_.document.edit("/align/paths", {"second.csv"}, "");
  const FakeHub::Answer written = bench_.call("align.write", args_of({{"into", true}}));
  ASSERT_EQ(written.error, "");
  EXPECT_EQ(written.result["scene"], "laid/scene.json");
  EXPECT_THAT(written.result["command"].get<std::string>(), HasSubstr("--into 'laid/scene.json'"));
  const Json registration = parse_json(read_file(bench_.folder / "laid" / "registration.json", 1U << 30U));
  ASSERT_EQ(registration.at("scans").size(), 2U);
  EXPECT_EQ(registration.at("scans")[1].at("name"), "second");
  EXPECT_EQ(registration.at("scans")[1].at("texture"), 2);
}

TEST_F(AlignRunTest, APoseMovedByHandHasAVerdictOfItsOwn) {
  const Json result = bench_.call("align.run", args_of({{"guess", true}})).result;
  ASSERT_TRUE(result["trustworthy"].get<bool>()) << result["verdict"];
  const Json same = bench_.call("align.judge", args_of({{"pose", result["T_mesh_world"]}})).result;
  EXPECT_TRUE(same["trustworthy"].get<bool>()) << same.dump();
  Json pose = result["T_mesh_world"];
  pose[0] = pose[0].get<double>() + 0.02;
  const Json moved = bench_.call("align.judge", args_of({{"pose", pose}})).result;
  EXPECT_FALSE(moved["trustworthy"].get<bool>()) << moved.dump();
  // The registration's own verdict is still about its own pose.
  EXPECT_EQ(bench_.call("align.result").result, result);
}

TEST_F(AlignRunTest, TheRunnerUpIsTakenAndKept) {
  // From anywhere there is nearly always another position that is next best.
  bench_.document.edit("/align/config", parse_json(R"({"search.rotations":"200","search.positions":"20"})"), "");
  const Json result = bench_.call("align.run", args_of({{"guess", false}})).result;
  ASSERT_TRUE(result.is_object());
  EXPECT_TRUE(result["guess"].is_null());
  ASSERT_TRUE(result["runner_up"].is_object());
  bench_.call("align.accept", args_of({{"solution", "runner_up"}}));
  const Json& section = bench_.document.section("align");
  EXPECT_EQ(section["T_mesh_world"], result["runner_up"]["T_mesh_world"]);
  EXPECT_EQ(section["registered"]["guess"], section["T_mesh_world"]);
  EXPECT_TRUE(section["registered"]["near"].get<bool>());
  const RegisterConfig config = run_config(choice_of_json(section), true);
  EXPECT_EQ(config.search.registration.starts.when, OtherStarts::kNever);
  EXPECT_EQ(config.refinement.other_starts, 0);
}

TEST_F(AlignRunTest, IsCancelledAndWritesNothingThen) {
  const std::uint64_t run = bench_.begin("align.run", args_of({{"guess", false}}));
  const std::uint64_t write = bench_.begin("align.write", args_of({{"name", "never"}}));
  bench_.call("job.cancel", args_of({{"job", 3}}));
  bench_.call("job.cancel", args_of({{"job", 2}}));
  EXPECT_EQ(bench_.answer_to(run).error, "cancelled");
  EXPECT_EQ(bench_.answer_to(write).error, "cancelled");
  EXPECT_FALSE(std::filesystem::exists(bench_.folder / "never"));
  EXPECT_TRUE(bench_.call("align.result").result.is_null());
}

TEST_F(AlignRunTest, AResultIsThereAgainAfterARestart) {
  const Json first = bench_.call("align.run", args_of({{"guess", true}})).result;
  ASSERT_TRUE(first.is_object());
  // The document is all that a restart leaves.
  write_file(bench_.folder.path() / "again.json", bench_.document.take_unsaved().value());
  Calls calls;
  Document document(bench_.folder.path() / "again.json");
  Shared shared{bench_.hub, bench_.project, document, *bench_.jobs, bench_.lease, true, bench_.shared.post};
  const std::unique_ptr<Page> page = make_align_page(shared);
  page->bind(document, calls);
  document.load();
  EXPECT_THAT(document.problems(), testing::IsEmpty());
  const std::size_t told = bench_.hub.events("align.result").size();
  calls.dispatch(Request(bench_.hub, 1, Call{1000, "align.open", Json::object()}));
  const std::vector<Json> events = bench_.wait_for_events("align.result", told + 1);
  ASSERT_EQ(events.size(), told + 1);
  EXPECT_EQ(events.back(), first);  // the same, to the last digit
  calls.dispatch(Request(bench_.hub, 1, Call{1001, "align.iterations", Json::object()}));
  EXPECT_FALSE(ReadBlock(bench_.hub.answer_to(1001).block).array<double>("rms_m").empty());
}

TEST_F(AlignRunTest, UndoTakesAResultBackAndRedoBringsIt) {
  const Json first = bench_.call("align.run", args_of({{"guess", true}})).result;
  EXPECT_EQ(bench_.document.undo_label(), "register");
  bench_.document.undo();
  EXPECT_TRUE(bench_.call("align.result").result.is_null());
  EXPECT_TRUE(bench_.hub.events("align.result").back().is_null());
  const std::size_t told = bench_.hub.events("align.result").size();
  bench_.document.redo();
  Json again = bench_.wait_for_events("align.result", told + 1).back();
  EXPECT_EQ(again["T_mesh_world"], first["T_mesh_world"]);
  EXPECT_EQ(again["verdict"], first["verdict"]);
  EXPECT_NE(again["run"], first["run"]);
}

TEST_F(AlignRunTest, AResultIsOfTheSettingsThatGaveIt) {
  const Json first = bench_.call("align.run", args_of({{"guess", true}})).result;
  bench_.document.edit("/align/config", parse_json(R"({"search.registration.max_points":"100"})"), "a setting");
  const Json second = bench_.call("align.run", args_of({{"guess", true}})).result;
  EXPECT_NE(second["T_mesh_world"], first["T_mesh_world"]);
  EXPECT_EQ(bench_.document.undo_label(), "register");
  std::size_t told = bench_.hub.events("align.result").size();
  bench_.document.undo();
  // null for the one that was taken back, and what there was before it.
  const Json before = bench_.wait_for_events("align.result", told + 2).back();
  EXPECT_EQ(before["T_mesh_world"], first["T_mesh_world"]);
  EXPECT_EQ(before["verdict"], first["verdict"]);
  told = bench_.hub.events("align.result").size();
  bench_.document.redo();
  EXPECT_EQ(bench_.wait_for_events("align.result", told + 2).back()["T_mesh_world"], second["T_mesh_world"]);
}

TEST_F(AlignRunTest, FilesThatAreChangedMeanwhileHaveNoResult) {
  const std::uint64_t run = bench_.begin("align.run", args_of({{"guess", true}}));
  bench_.document.edit("/align/mesh_unit", "cm", "the unit");
  EXPECT_THAT(bench_.answer_to(run).error, HasSubstr("were changed"));
  EXPECT_THAT(bench_.hub.events("align.result"), testing::IsEmpty());
  EXPECT_EQ(bench_.document.undo_label(), "the unit");
}

TEST_F(AlignRunTest, ACancelledOneIsNotBegunAgainByItself) {
  bench_.call("align.run", args_of({{"guess", true}}));
  bench_.document.undo();
  const std::size_t told = bench_.hub.events("job").size();
  bench_.document.redo();
  ASSERT_GT(bench_.hub.events("job").size(), told);
  const Json job = bench_.hub.events("job")[told];
  EXPECT_THAT(job["title"].get<std::string>(), HasSubstr("again"));
  bench_.call("job.cancel", args_of({{"job", job["id"]}}));
  std::vector<Json> states = bench_.hub.events("job");
  while (states.back()["state"] == "waiting" || states.back()["state"] == "running")
    states = bench_.wait_for_events("job", states.size() + 1);
  bench_.call("align.open");
  states = bench_.hub.events("job");
  for (std::size_t i = told; i < states.size(); ++i) EXPECT_EQ(states[i]["id"], job["id"]) << states[i].dump();
}

}  // namespace
}  // namespace asperity::studio
