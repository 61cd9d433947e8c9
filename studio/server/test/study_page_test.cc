#include "study/study_page.h"

#include <fstream>

#include "asperity/study/study_file.h"
#include "read_block.h"
#include "study_page_fixture.h"

namespace asperity::studio {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_F(StudyPageTest, AsksAllPairsAndGivesTheResults) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 3);
  ASSERT_EQ(rig.ask("study.begin").error, "");
  EXPECT_EQ(rig.status()["phase"], "running");
  EXPECT_EQ(rig.session()["of"], 6);
  rig.touch();
  for (int trial = 1; trial <= 6; ++trial) {
    EXPECT_EQ(rig.session()["trial"], trial);
    EXPECT_EQ(rig.answer(trial % 2).error, "");
  }
  EXPECT_EQ(rig.status()["phase"], "finished");
  EXPECT_TRUE(rig.pump([&] { return rig.ask("feel.status").result["state"] == "idle"; }));
  EXPECT_THAT(rig.ask("study.results", {{"log", "study_p01.study.csv"}}).error, HasSubstr("being written"));
  // By any name.
  std::filesystem::create_symlink("study_p01.study.csv", folder / "other.study.csv");
  for (const char* name : {"./study_p01.study.csv", ".//study_p01.study.csv", "other.study.csv"}) {
    EXPECT_THAT(rig.ask("study.results", {{"log", name}}).error, HasSubstr("being written")) << name;
    EXPECT_THAT(rig.ask("study.export", {{"log", name}}).error, HasSubstr("being written")) << name;
  }
  EXPECT_EQ(rig.ask("study.end").error, "");
  const Json results = rig.ask("study.results", {{"log", rig.status()["last_log"]}}).result;
  double wins = 0.0;
  for (const Json& row : results["wins"]) {
    for (const Json& each : row) wins += each.is_null() ? 0.0 : each.get<double>();
  }
  EXPECT_EQ(wins, 6.0);
  EXPECT_EQ(results["left"]["count"], 3.0);
  EXPECT_TRUE(results["whole"].get<bool>());
  EXPECT_FALSE(std::filesystem::exists(folder / ".asperity-study.json"));
}

TEST_F(StudyPageTest, TellsTheBrowserNothingOfTheTextures) {
  StudyRig rig(folder.path());
  rig.set_up("staircase", 1);
  // Stiffer than the device bears: on the Feel page the renderer would warn, naming the texture.
  rig.document.edit("/study/study/presentation/stiffness_N_per_m", 1e6, "stiffness");
  ASSERT_EQ(rig.ask("study.begin").error, "");
  rig.touch();
  const std::string told = rig.status().dump() + rig.ask("feel.status").result.dump();
  for (const char* word : {"tile0", "level", "comparison", "reversal"}) EXPECT_THAT(told, Not(HasSubstr(word)));
  const ReadBlock block(rig.ask("study.open").block);
  EXPECT_THAT(block.head.dump(), Not(HasSubstr("tile0")));
  EXPECT_EQ(block.head["textures"].size(), 2U);
  EXPECT_TRUE(block.array<float>("height_0").empty());
  EXPECT_TRUE(rig.ask("feel.status").result["warnings"].empty());
  // Pressed into a tile: the hand touches it, and the browser sees neither height nor parts of the force.
  rig.pointing = true;
  rig.pointer_m = {0.019, 0.019, -0.004};
  EXPECT_TRUE(rig.pump([&] { return rig.hub.state().is_object() && rig.hub.state()["touching"].get<bool>(); }));
  EXPECT_EQ(rig.hub.state()["height_m"], 0.0);
  EXPECT_TRUE(rig.hub.ticks().empty());
}

TEST_F(StudyPageTest, TellsAnObserverNothingOfWhatWasTouched) {
  constexpr ClientId kObserver = StudyRig::kOwner + 1;
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  ASSERT_EQ(rig.ask("study.begin").error, "");
  const std::size_t before = rig.hub.events("feel").size();
  rig.touch();
  rig.pointing = true;
  rig.pointer_m = {0.019, 0.019, -0.004};
  EXPECT_TRUE(rig.pump([&] { return rig.hub.state().is_object() && rig.hub.state()["touching"].get<bool>(); }));
  // The values of a run have the heights under the tip and the largest force of the texture.
  EXPECT_EQ(rig.ask("study.touch", {{"on", false}}).error, "");
  EXPECT_TRUE(rig.pump([&] { return rig.ask("feel.status").result["state"] == "idle"; }));
  EXPECT_TRUE(rig.ask("feel.status", Json::object(), kObserver).result["last_run"].is_null());
  std::string told = rig.ask("study.status", Json::object(), kObserver).result.dump();
  const std::vector<Json> feel = rig.hub.events("feel"), study = rig.hub.events("study");
  ASSERT_GT(feel.size(), before);
  for (const Json& each : feel) told += each.dump();
  for (const Json& each : study) told += each.dump();
  for (const char* word : {"tile0", "tile1", "texture_N", "height", "figures", "left", "right"}) {
    EXPECT_THAT(told, Not(HasSubstr(word)));
  }
  EXPECT_THAT(rig.ask("study.results", {{"log", "study_p01.study.csv"}}, kObserver).error, HasSubstr("being written"));
}

TEST_F(StudyPageTest, TheForceIsTheFeelPagesOwn) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  ASSERT_EQ(rig.ask("study.begin").error, "");
  rig.touch();
  EXPECT_TRUE(rig.ask("feel.status").result["visited"].get<bool>());
  EXPECT_THAT(rig.ask("feel.start").error, HasSubstr("running already"));
  // Nobody changes what is under the hand; anybody lowers the force, and stops.
  Edit edit;
  edit.path = "/feel/range_mm";
  edit.after = 1.0;
  EXPECT_THROW(rig.feel.check_edit(StudyRig::kOwner, edit), Advice);
  edit.path = "/feel/max_force_N";
  EXPECT_NO_THROW(rig.feel.check_edit(StudyRig::kOwner + 1, edit));
  EXPECT_EQ(rig.ask("feel.stop", Json::object(), StudyRig::kOwner + 1).error, "");
  EXPECT_TRUE(rig.pump([&] { return !rig.session()["touching"].get<bool>(); }));
  EXPECT_FALSE(rig.session()["ready"].get<bool>());
  // Between two trials there is none.
  rig.touch();
  EXPECT_EQ(rig.answer(0).error, "");
  EXPECT_FALSE(rig.session()["ready"].get<bool>());
  EXPECT_TRUE(rig.pump([&] { return rig.session()["ready"].get<bool>(); }));
  // It ends with the window that began it.
  rig.study.client_left(StudyRig::kOwner);
  EXPECT_TRUE(rig.pump([&] { return rig.ask("feel.status").result["state"] == "idle"; }));
}

TEST_F(StudyPageTest, IsTouchedAgainAtOnceAfterTheLastTouchWasLeft) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  ASSERT_EQ(rig.ask("study.begin").error, "");
  rig.touch();
  // Without a turn of the loop between: the run that ends is still there.
  EXPECT_EQ(rig.ask("study.touch", {{"on", false}}).error, "");
  EXPECT_FALSE(rig.session()["touching"].get<bool>());
  rig.touch();
  EXPECT_EQ(rig.answer(0).error, "");
}

TEST_F(StudyPageTest, IsNotTouchedAfterTheTouchWasCalledOff) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  ASSERT_EQ(rig.ask("study.begin").error, "");
  rig.touch();
  // On waits for the end of the touch before, and off comes while it does.
  Call calls[3];
  for (int k = 0; k < 3; ++k) {
    calls[k].id = ++rig.id;
    calls[k].name = "study.touch";
    calls[k].args = {{"on", k == 1}};
    rig.calls.dispatch(Request(rig.hub, StudyRig::kOwner, calls[k]));
  }
  EXPECT_TRUE(rig.pump([&] { return rig.ask("feel.status").result["state"] == "idle"; }));
  EXPECT_FALSE(rig.session()["touching"].get<bool>());
  for (const Call& call : calls) EXPECT_EQ(rig.hub.answer_to(call.id).error, "");
}

TEST_F(StudyPageTest, IsNotTouchableWithoutAForce) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  ASSERT_EQ(rig.ask("study.begin").error, "");
  rig.beating = false;
  EXPECT_EQ(rig.ask("study.touch", {{"on", true}}).error, "");
  EXPECT_TRUE(rig.pump([&] { return rig.ask("feel.status").result["state"] == "running"; }));
  // Nobody holds the lease.
  EXPECT_FALSE(rig.session()["ready"].get<bool>());
  EXPECT_THAT(rig.ask("study.answer", {{"trial", 1}, {"answer", 0}}).error, HasSubstr("nothing was touched"));
  rig.beating = true;
  EXPECT_TRUE(rig.pump([&] { return rig.session()["ready"].get<bool>(); }));
  // It lapses: the clock of the response is.
  rig.beating = false;
  EXPECT_TRUE(rig.pump([&] { return !rig.session()["ready"].get<bool>(); }));
  EXPECT_TRUE(rig.session()["touching"].get<bool>());
  rig.beating = true;
  EXPECT_EQ(rig.answer(0).error, "");
}

TEST_F(StudyPageTest, IsNotTouchedWhereNoForceIsCommanded) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  rig.shared.may_command_forces = false;
  ASSERT_EQ(rig.ask("study.begin").error, "");
  EXPECT_THAT(rig.ask("study.touch", {{"on", true}}).error, HasSubstr("does not command forces"));
}

// An answer counts only after both textures were pressed on.
TEST_F(StudyPageTest, TakesNoAnswerBeforeBothWereTouchedWithForce) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  ASSERT_EQ(rig.ask("study.begin").error, "");
  rig.touch();
  const Json first{{"trial", 1}, {"answer", 0}};
  EXPECT_THAT(rig.ask("study.answer", first).error, HasSubstr("not both textures were touched with force"));
  rig.press(false);
  EXPECT_FALSE(rig.session()["may_answer"].get<bool>());
  EXPECT_THAT(rig.ask("study.answer", first).error, HasSubstr("not both"));
  rig.press(true);
  EXPECT_TRUE(rig.session()["may_answer"].get<bool>());
  EXPECT_EQ(rig.ask("study.answer", first).error, "");
  EXPECT_FALSE(rig.session()["touched_a"].get<bool>()) << "of the next trial";
  const StudyLog written = parse_study_log(log(), "log");
  for (const TileTouch& touch : written.session.answers().front().touches) {
    EXPECT_GE(touch.touch_s, 0.2);
    EXPECT_GE(touch.force_N, 0.1);
  }
}

TEST_F(StudyPageTest, BeginsWithConsentWhereItIsAskedFor) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  rig.document.edit("/study/study/consent", "I take part of my own will.", "consent");
  EXPECT_THAT(rig.ask("study.begin").error, HasSubstr("has not agreed"));
  EXPECT_THAT(rig.ask("study.begin", {{"consented", false}}).error, HasSubstr("has not agreed"));
  EXPECT_EQ(rig.ask("study.begin", {{"consented", true}}).error, "");
  EXPECT_THAT(log(), HasSubstr("I take part of my own will."));
}

TEST_F(StudyPageTest, TakesNoAnswerThatIsNone) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  EXPECT_THAT(rig.ask("study.answer", {{"trial", 1}, {"answer", 0}}).error, HasSubstr("no trial is open"));
  ASSERT_EQ(rig.ask("study.begin").error, "");
  EXPECT_THAT(rig.ask("study.answer", {{"trial", 1}, {"answer", 0}}).error, HasSubstr("nothing was touched"));
  rig.touch();
  rig.press_all();
  EXPECT_THAT(rig.ask("study.answer", {{"trial", 2}, {"answer", 0}}).error, HasSubstr("answered already"));
  EXPECT_THAT(rig.ask("study.answer", {{"trial", 1}, {"answer", 2}}).error, HasSubstr("not an answer"));
  EXPECT_THAT(rig.ask("study.answer", {{"trial", 1}, {"answer", 1e15}}).error, HasSubstr("not an answer"));
  EXPECT_EQ(rig.session()["answers"], 0);
}

TEST_F(StudyPageTest, IsFeltOnWhenAnAnswerIsTakenBackAtOnce) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  ASSERT_EQ(rig.ask("study.begin").error, "");
  rig.touch();
  // Two trials are laid without a turn of the loop between: the first is given up for the second.
  Call answer, back;
  answer.id = ++rig.id;
  answer.name = "study.answer";
  answer.args = {{"trial", 1}, {"answer", 0}};
  back.id = ++rig.id;
  back.name = "study.take_back";
  back.args = Json::object();
  for (const Call& call : {answer, back}) rig.calls.dispatch(Request(rig.hub, StudyRig::kOwner, call));
  EXPECT_TRUE(rig.pump([&] { return rig.session()["ready"].get<bool>(); }));
  EXPECT_EQ(rig.session()["trial"], 1);
  EXPECT_TRUE(rig.session()["touching"].get<bool>());
  EXPECT_EQ(rig.answer(0).error, "");
}

TEST_F(StudyPageTest, TakesTheLastAnswerBackAlsoAtTheEnd) {
  StudyRig rig(folder.path());
  rig.set_up("rating", 1);
  ASSERT_EQ(rig.ask("study.begin").error, "");
  rig.touch();
  EXPECT_EQ(rig.answer(7).error, "");
  EXPECT_EQ(rig.status()["phase"], "finished");
  EXPECT_EQ(rig.ask("study.take_back").error, "");
  EXPECT_EQ(rig.status()["phase"], "running");
  EXPECT_THAT(rig.ask("study.take_back").error, HasSubstr("no answer can be withdrawn"));
  EXPECT_TRUE(rig.pump([&] { return rig.ask("feel.status").result["state"] == "idle"; }));
  rig.touch();
  EXPECT_EQ(rig.answer(2).error, "");
  EXPECT_EQ(rig.ask("study.end").error, "");
  const Json results = rig.ask("study.results", {{"log", "study_p01.study.csv"}}).result;
  EXPECT_EQ(results["ratings"][0]["counts"], Json({0, 1, 0, 0, 0, 0, 0}));
  EXPECT_THAT(log(), HasSubstr("taken_back,1,"));
}

TEST_F(StudyPageTest, HasBreaksAndPausesAndRunsOfTheirOwn) {
  StudyRig rig(folder.path());
  rig.set_up("pairs", 2);
  rig.document.edit("/study/study/break_every", 1, "breaks");
  ASSERT_EQ(rig.ask("study.begin").error, "");
  rig.touch();
  EXPECT_EQ(rig.answer(1).error, "");
  EXPECT_EQ(rig.status()["why"], "break");
  EXPECT_THAT(rig.ask("study.touch", {{"on", true}}).error, HasSubstr("no trial is open"));
  EXPECT_EQ(rig.ask("study.resume").error, "");
  EXPECT_EQ(rig.ask("study.pause").error, "");
  EXPECT_EQ(rig.status()["why"], "pause");
  EXPECT_EQ(rig.ask("study.end").error, "");
  ASSERT_EQ(rig.ask("study.begin").error, "");
  EXPECT_EQ(rig.status()["log"], "study_p01_2.study.csv");
  EXPECT_EQ(rig.ask("study.end").error, "");
  EXPECT_EQ(rig.ask("study.continue", {{"log", "./study_p01.study.csv"}}).error, "");
  EXPECT_EQ(rig.session()["trial"], 2);
  EXPECT_EQ(rig.status()["log"], "study_p01.study.csv");
}

TEST_F(StudyPageTest, KeepsStudiesInFiles) {
  StudyRig rig(folder.path());
  rig.set_up("rating", 4);
  EXPECT_THAT(rig.ask("study.write", {{"name", "a.json"}}).error, HasSubstr("not the name of a study"));
  EXPECT_EQ(rig.ask("study.write", {{"name", "a.study.json"}}).error, "");
  EXPECT_THAT(rig.ask("study.write", {{"name", "a.study.json"}}).error, HasSubstr("exists already"));
  EXPECT_EQ(rig.ask("study.write", {{"name", "a.study.json"}, {"replace", true}}).error, "");
  EXPECT_EQ(rig.ask("study.read", {{"name", "a.study.json"}}).result, rig.document.section("study")["study"]);
  EXPECT_THAT(rig.ask("study.read", {{"name", "../a.study.json"}}).error, HasSubstr("not a name inside"));
  EXPECT_THROW(rig.document.edit("/study/participant", "a b", "participant"), Error);
  EXPECT_THROW(rig.document.edit("/study/study/presentation/device", "hammer", "device"), Error);
  EXPECT_THROW(rig.document.edit("/study/study/stimuli", Json::array({" a.png"}), "textures"), Error);
  EXPECT_THROW(rig.document.edit("/study/study/stimuli", Json::array({"a,b.png"}), "textures"), Error);
  EXPECT_EQ(rig.ask("study.fields").result[0]["path"], "staircase.parameter");
}

}  // namespace
}  // namespace asperity::studio
