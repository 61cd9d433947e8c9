#include "feel/feel_page.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "feel/run_log.h"
#include "feel_rig.h"

namespace asperity::studio {
namespace {

using testing::HasSubstr;

// From the last tick at which the force was as rendered, those until it was zero for good.
std::size_t ramp_ticks(const std::vector<FeelHub::Tick>& ticks) {
  std::size_t zero = ticks.size();
  while (zero > 0 && ticks[zero - 1].out_N == 0.0) --zero;
  std::size_t full = zero;
  while (full > 0 && ticks[full - 1].out_N < 0.98 * ticks[full - 1].rendered_N) --full;
  return zero - full;
}

// The largest change of force from tick to tick beyond what the rate limit allows in the time between them.
double beyond_rate_N(const std::vector<FeelHub::Tick>& ticks) {
  double worst_N = 0.0;
  const SafetyConfig safety;
  for (std::size_t k = 1; k < ticks.size(); ++k) {
    const double dt_s = std::min(ticks[k].t_s - ticks[k - 1].t_s, 3e-3);
    worst_N = std::max(worst_N, std::abs(ticks[k].out_N - ticks[k - 1].out_N) - dt_s * safety.max_force_rate_N_per_s);
  }
  return worst_N;
}

}  // namespace

TEST(FeelPage, IsFeltWithThePointerWhileItHasTheForce) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  EXPECT_EQ(rig.call("feel.start").error, "");
  EXPECT_EQ(rig.status()["state"], "running");
  rig.touch();
  EXPECT_LE(rig.hub.newest().out_N, 5.0);
  EXPECT_TRUE(rig.wait(
      [&] { return rig.hub.state()["touching"].get<bool>() && rig.hub.state()["height_m"].get<double>() > 0.0; }));

  // Its heartbeats stop: nothing else is done.
  rig.beating.clear();
  EXPECT_TRUE(rig.wait([&] { return rig.hub.newest().out_N == 0.0; }));
  const std::vector<FeelHub::Tick> ticks = rig.hub.ticks();
  // ramp_down_s is 20 ticks; ticks that came late count for more, none for less.
  EXPECT_LE(ramp_ticks(ticks), 22U);
  EXPECT_LE(beyond_rate_N(ticks), 1e-6);
  EXPECT_GT(ticks.back().rendered_N, 0.3);  // it is still shown what a hand would feel
  EXPECT_TRUE(rig.wait([&] {
    const Json state = rig.hub.state();
    return std::count(state["limited"].begin(), state["limited"].end(), "not-permitted") == 1;
  }));

  // And it returns with the lease.
  rig.own_force();
  EXPECT_TRUE(rig.wait([&] { return rig.hub.newest().out_N > 0.3; }));
}

TEST(FeelPage, AnyoneMayStop) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  ASSERT_EQ(rig.call("feel.start").error, "");
  rig.touch();
  EXPECT_EQ(rig.call("feel.stop", Json::object(), FeelRig::kOwner + 1).error, "");
  EXPECT_TRUE(rig.wait([&] { return rig.status()["state"] == "idle"; }));
  EXPECT_EQ(rig.hub.newest().out_N, 0.0);
  EXPECT_LE(ramp_ticks(rig.hub.ticks()), 22U);
  EXPECT_EQ(rig.status()["last_run"]["end"], "stopped");
  // And again.
  EXPECT_EQ(rig.call("feel.start").error, "");
  rig.touch();
}

TEST(FeelPage, ChangesWhileTouchingDoNotStepTheForce) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  ASSERT_EQ(rig.call("feel.start").error, "");
  rig.touch();
  const std::array<std::pair<const char*, Json>, 4> edits{{{"/feel/settings/render.texture.model", "stochastic"},
                                                           {"/feel/settings/render.friction", 0.4},
                                                           {"/feel/settings/render.stiffness_N_per_m", 900.0},
                                                           {"/feel/range_mm", 0.5}}};
  for (const auto& [path, value] : edits) {
    const Json before = rig.status()["felt"];
    rig.document.edit(path, value, "change");
    EXPECT_TRUE(rig.wait([&] { return rig.status()["felt"] != before; })) << path;
    const std::size_t ticks = rig.hub.ticks().size();
    EXPECT_TRUE(rig.wait([&] { return rig.hub.ticks().size() > ticks + 150 && rig.hub.newest().out_N > 0.2; }));
  }
  EXPECT_LE(beyond_rate_N(rig.hub.ticks()), 1e-6);
  EXPECT_EQ(rig.status()["problem"], "");
}

TEST(FeelPage, ASceneThatCannotBeReadLeavesTheRunningOneAlone) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  ASSERT_EQ(rig.call("feel.start").error, "");
  rig.touch();
  const Json before = rig.status();
  std::ofstream(rig.folder / "broken.pgm") << "P5\nthis is no image";
  rig.document.edit("/feel/height_maps", {"broken.pgm"}, "choose");
  EXPECT_TRUE(rig.wait([&] { return rig.status()["problem"] != ""; }));
  EXPECT_THAT(rig.status()["problem"].get<std::string>(), HasSubstr("broken.pgm"));
  EXPECT_EQ(rig.status()["state"], "running");
  EXPECT_EQ(rig.status()["felt"], before["felt"]);
  const std::size_t ticks = rig.hub.ticks().size();
  EXPECT_TRUE(rig.wait([&] { return rig.hub.ticks().size() > ticks + 100 && rig.hub.newest().out_N > 0.3; }));
  rig.document.undo();
  EXPECT_TRUE(rig.wait([&] { return rig.status()["problem"] == ""; }));
}

TEST(FeelPage, WhatIsFeltStaysShownWhenNothingIsChosenAnyMore) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  ASSERT_EQ(rig.call("feel.start").error, "");
  rig.touch();
  const Json shown = rig.status()["revision"];
  rig.document.edit("/feel/height_maps", Json::array(), "none");
  EXPECT_EQ(rig.status()["revision"], shown);
  EXPECT_EQ(rig.status()["problem"], "nothing is chosen");
  EXPECT_THAT(rig.status()["hint"].get<std::string>(), HasSubstr("4 height maps until you stop"));
  EXPECT_EQ(rig.call("feel.open").error, "");
  EXPECT_GT(rig.hub.newest().out_N, 0.0);
  EXPECT_EQ(rig.call("feel.stop").error, "");
  ASSERT_TRUE(rig.wait([&] { return rig.status()["state"] == "idle"; }));
  EXPECT_TRUE(rig.status()["revision"].is_null());
  EXPECT_EQ(rig.status()["problem"], "");
}

TEST(FeelPage, TheLargestForceIsLoweredFromTheBrowserAndNotRaised) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  ASSERT_EQ(rig.call("feel.start").error, "");
  rig.touch();
  rig.document.edit("/feel/max_force_N", 0.1, "limit");
  EXPECT_TRUE(rig.wait([&] { return rig.hub.newest().out_N <= 0.1 + 1e-6; }));
  rig.document.edit("/feel/max_force_N", 500.0, "limit");
  EXPECT_EQ(rig.status()["max_force_N"], SafetyConfig().max_force_N);
}

TEST(FeelPage, WritesALog) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  EXPECT_NE(rig.call("feel.log", {{"on", true}}).error, "");
  ASSERT_EQ(rig.call("feel.start").error, "");
  EXPECT_EQ(rig.call("feel.log", {{"on", true}}).result["log"], "feel.csv");
  const std::size_t ticks = rig.hub.ticks().size();
  EXPECT_TRUE(rig.wait([&] { return rig.hub.ticks().size() > ticks + 100; }));
  EXPECT_EQ(rig.call("feel.log", {{"on", false}}).result["log"], "feel.csv");
  std::ifstream file(rig.folder / "feel.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, kFeelLogColumns);
  int rows = 0;
  while (std::getline(file, line)) ++rows;
  EXPECT_GT(rows, 50);
  // The next one is another file, and is whole when the run ends.
  EXPECT_EQ(rig.call("feel.log", {{"on", true}}).result["log"], "feel_2.csv");
  rig.call("feel.stop");
  EXPECT_TRUE(rig.wait([&] { return rig.status()["state"] == "idle" && rig.status()["log"] == ""; }));
  EXPECT_TRUE(std::filesystem::exists(rig.folder / "feel_2.csv"));
}

// The run passes it over as soon as it is asked to, and at its end.
TEST(RunLog, IsHandedOverWhenAskedForAndAtTheEnd) {
  testkit::TempDir folder;
  std::vector<FinishedLog> ended;
  RunLog log([&](FinishedLog one) { ended.push_back(std::move(one)); });
  const ServoTick tick;
  log.add(tick);
  log.begin(std::make_unique<FeelLog>(folder / "whole.csv", false));
  log.add(tick);
  log.end();
  log.add(tick);
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].fault, "");
  ended[0].log->commit();
  EXPECT_TRUE(std::filesystem::exists(folder / "whole.csv"));
  // Not asked for, it ends with the run.
  log.begin(std::make_unique<FeelLog>(folder / "second.csv", false));
  log.add(tick);
  log.finish();
  ASSERT_EQ(ended.size(), 2U);
  EXPECT_NE(ended[1].log, nullptr);
}

TEST(FeelPage, ASceneThatWasWrittenAnewIsReadAnew) {
  FeelRig rig;
  rig.document.edit("/feel/scene", "plate.obj", "choose");
  EXPECT_TRUE(rig.wait([&] { return rig.status()["title"] == "plate.obj"; }));
  EXPECT_EQ(ReadBlock(rig.call("feel.open").block).array<std::uint32_t>("triangles_0").size(), 6U);
  std::ofstream(rig.folder / "plate.obj") << "v 0 0 0\nv 0.02 0 0\nv 0.02 0.02 0\nf 1 2 3\n";
  ASSERT_EQ(rig.call("feel.start").error, "");
  EXPECT_EQ(ReadBlock(rig.call("feel.open").block).array<std::uint32_t>("triangles_0").size(), 3U);
}

TEST(FeelPage, WhatNobodySeesIsNotMade) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.hub.subscribed = false;
  write_path(rig.folder / "path.csv");
  rig.document.edit("/feel/device", "replay", "device");
  rig.document.edit("/feel/replay", "path.csv", "path");
  ASSERT_EQ(rig.call("feel.start").error, "");
  EXPECT_TRUE(rig.wait([&] { return rig.status()["state"] == "idle"; }));
  EXPECT_GT(rig.status()["last_run"]["figures"]["ticks"].get<int>(), 0);
  EXPECT_EQ(rig.hub.frames_of("feel.state") + rig.hub.frames_of("feel.ticks") + rig.hub.frames_of("feel.sound"), 0U);
}

TEST(FeelPage, ShowsTheSceneWithItsHeights) {
  FeelRig rig;
  EXPECT_NE(rig.call("feel.open").error, "");
  rig.choose_height_maps();
  const ReadBlock block(rig.call("feel.open").block);
  const Json& head = block.head;
  EXPECT_EQ(head["objects"], 1U);
  ASSERT_EQ(head["textures"].size(), 4U);
  EXPECT_EQ(rig.status()["models"][2], "normal-perturbation");
  // A change of the force alone is not drawn again.
  const Json drawn = rig.status()["revision"], felt = rig.status()["felt"];
  rig.document.edit("/feel/settings/render.friction", 0.3, "friction");
  EXPECT_TRUE(rig.wait([&] { return rig.status()["felt"] != felt; }));
  EXPECT_EQ(rig.status()["revision"], drawn);
  EXPECT_EQ(block.array<float>("height_0").size(), 256U * 256U);
  const auto texture = block.array<std::int32_t>("texture_0");
  EXPECT_EQ(block.array<std::uint32_t>("triangles_0").size(), 3 * texture.size());
  EXPECT_EQ(*std::max_element(texture.begin(), texture.end()), 3);
  EXPECT_EQ(*std::min_element(texture.begin(), texture.end()), -1);  // the plane between the tiles

  rig.document.edit("/feel/height_maps", Json::array(), "choose");
  rig.document.edit("/feel/scene", "plate.obj", "choose");
  EXPECT_TRUE(rig.wait([&] { return rig.status()["title"] == "plate.obj"; }));
  EXPECT_EQ(ReadBlock(rig.call("feel.open").block).head["textures"].size(), 0U);
}

TEST(FeelPage, ARecordedPathAndTheModelledHandEndByThemselvesOrWhenStopped) {
  FeelRig rig;
  rig.choose_height_maps();
  write_path(rig.folder / "path.csv");
  rig.document.edit("/feel/device", "replay", "device");
  EXPECT_THAT(rig.call("feel.start").error, HasSubstr("recorded path is missing"));
  rig.document.edit("/feel/replay", "path.csv", "path");
  rig.own_force();
  EXPECT_EQ(rig.call("feel.start").error, "");
  EXPECT_TRUE(rig.wait([&] { return rig.status()["state"] == "idle"; }));
  EXPECT_EQ(rig.status()["last_run"]["end"], "end of the path");
  EXPECT_GT(rig.status()["last_run"]["figures"]["force"]["peak_N"].get<double>(), 0.1);
}

}  // namespace asperity::studio
