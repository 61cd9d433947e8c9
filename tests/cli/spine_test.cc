#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"
#include "wait_until_begun.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using Words = std::vector<std::string>;

Outcome simulate(const fs::path& recording, const std::string& surface, int seed, const Words& more = {}) {
  Words words{"simulate", "--surface",          surface, "--probe",         "open", "--speed", "25mm/s",
              "--seed",   std::to_string(seed), "-o",    recording.string()};
  words.insert(words.end(), more.begin(), more.end());
  return run(words);
}

const Words kShort{"--set", "hand.length_m=0.03"};

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(Spine, ARecordingBecomesATexture) {
  const testkit::TempDir dir;
  ASSERT_EQ(simulate(dir / "rec", "protoboard", 1).code, 0);
  const Outcome outcome = run({"process", (dir / "rec").string(), "-o", (dir / "out").string(), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["format"], "asperity-result");
  EXPECT_EQ(json["method"], "fused");
  EXPECT_EQ(json["recording"], "rec");
  // The board's pitch is 2.5 mm, its holes 1.5 mm deep; a length error of 1 % and a bounce of a tenth are allowed.
  EXPECT_NEAR(json["periodicity"]["pitch_m"].get<double>(), 2.5e-3, 0.025e-3);
  EXPECT_NEAR(json["periodicity"]["depth_m"].get<double>(), 1.5e-3, 0.15e-3);
  EXPECT_GT(json["accuracy"]["correlation"].get<double>(), 0.9);
  EXPECT_LT(std::abs(json["accuracy"]["length_error_percent"].get<double>()), 1.0);
  EXPECT_EQ(json["config"]["method"], "fused");

  std::map<std::string, std::string> files;
  for (auto& [name, text] : contents(dir / "out")) files[name] = text;
  // The report needs the studio's app, which a machine without Node.js leaves out.
  EXPECT_EQ(files.size(), files.contains("report.html") ? 6U : 5U);
  EXPECT_EQ(files["result.json"], outcome.out);
  EXPECT_THAT(files["profile.csv"],
              ::testing::StartsWith("s_m,height_m,sigma_m,texture_m,force_N,speed_mps,texture_sigma_m\n"));
  EXPECT_THAT(files["trajectory.csv"],
              ::testing::StartsWith(
                  "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz,vx_mps,vy_mps,vz_mps,sigma_m,sigma_x_m,sigma_y_m,sigma_z_m\n"));
  EXPECT_THAT(files["spectrum.csv"],
              ::testing::StartsWith("cycles_per_mm,density_m2_mm,low_m2_mm,high_m2_mm,noise_m2_mm\n0,"));
  EXPECT_EQ(nlohmann::json::parse(files["texture.json"])["model"], "fourier1d");
  EXPECT_EQ(run({"roughness", (dir / "out" / "profile.csv").string()}).code, 0);
}

TEST(Spine, TheSameSeedGivesTheSameBytes) {
  const testkit::TempDir dir;
  for (const char* name : {"a", "b"}) {
    fs::create_directory(dir / name);
    ASSERT_EQ(simulate(dir / name / "rec", "sandpaper", 3, kShort).code, 0);
    for (const char* method : {"fused", "thesis"}) {
      const Outcome outcome =
          run({"process", (dir / name / "rec").string(), "-o", (dir / name / method).string(), "--method", method});
      ASSERT_TRUE(outcome.code == 0 || outcome.code == 3) << outcome.err;
    }
  }
  EXPECT_EQ(contents(dir / "a"), contents(dir / "b"));
  ASSERT_EQ(simulate(dir / "other", "sandpaper", 4, kShort).code, 0);
  EXPECT_NE(contents(dir / "other"), contents(dir / "a" / "rec"));
}

TEST(Spine, SeveralRecordingsGiveAFolderEach) {
  const testkit::TempDir dir;
  ASSERT_EQ(simulate(dir / "one", "sine", 1, kShort).code, 0);
  ASSERT_EQ(simulate(dir / "two", "sine", 2, kShort).code, 0);
  const Words words{"process", (dir / "one").string(), (dir / "two").string() + "/",
                    "-o",      (dir / "out").string(), "--json"};
  for (int time = 0; time < 2; ++time) {
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_TRUE(json["results"].contains("one"));
    EXPECT_TRUE(json["results"].contains("two"));
    EXPECT_TRUE(fs::exists(dir / "out" / "one" / "result.json"));
    EXPECT_TRUE(fs::exists(dir / "out" / "two" / "texture.json"));
    EXPECT_EQ(entries(dir.path()), 3u);
  }
  const Outcome twice = run({"process", (dir / "one").string(), (dir / "one").string(), "-o", (dir / "x").string()});
  EXPECT_EQ(twice.code, 2);
}

TEST(Spine, ResolvedSettingsReproduceTheResult) {
  const testkit::TempDir dir;
  ASSERT_EQ(simulate(dir / "rec", "sine", 1, kShort).code, 0);
  const std::string rec = (dir / "rec").string();
  const Words change{"--set", "profile.cutoff_cycles_per_mm=0.1", "--set", "texture.coefficients=64"};
  Words words{"process", rec, "-o", (dir / "a").string()};
  words.insert(words.end(), change.begin(), change.end());
  ASSERT_EQ(run(words).code, 0);
  words = {"process", "--print-config"};
  words.insert(words.end(), change.begin(), change.end());
  write_text(dir / "settings.toml", run(words).out);
  ASSERT_EQ(run({"process", rec, "-o", (dir / "b").string(), "--config", (dir / "settings.toml").string()}).code, 0);
  EXPECT_EQ(contents(dir / "a"), contents(dir / "b"));
}

TEST(Spine, ForeignFoldersStayAsTheyAre) {
  const testkit::TempDir dir;
  ASSERT_EQ(simulate(dir / "rec", "sine", 1, kShort).code, 0);
  fs::create_directory(dir / "theirs");
  write_text(dir / "theirs" / "letter.txt", "dear reader");
  const std::string theirs = (dir / "theirs").string();
  const auto before = contents(dir.path());
  for (const Words& words : std::vector<Words>{{"simulate", "--surface", "sine", "-o", theirs},
                                               {"process", (dir / "rec").string(), "-o", theirs},
                                               {"process", (dir / "rec").string(), "-o", (dir / "rec").string()},
                                               {"demo", "-o", theirs},
                                               {"demo", "-o", (dir / "rec").string()}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 1) << ::testing::PrintToString(words);
    EXPECT_THAT(outcome.err, HasSubstr("nothing was changed"));
    EXPECT_EQ(contents(dir.path()), before);
  }
  EXPECT_EQ(simulate(dir / "rec", "sine", 2, kShort).code, 0) << "our own folders are replaced";
}

TEST(Spine, BadInputEndsWith1AndLeavesNothing) {
  const testkit::TempDir dir;
  ASSERT_EQ(simulate(dir / "rec", "sine", 1, kShort).code, 0);
  const std::string rec = (dir / "rec").string();
  const std::string out = (dir / "out").string();
  EXPECT_EQ(run({"process", (dir / "absent").string(), "-o", out}).code, 1);
  EXPECT_EQ(run({"inspect", (dir / "absent").string()}).code, 1);
  write_text(dir / "rec" / "tracker.csv", "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz\n1,0,0,x,1,0,0,0\n");
  for (const char* command : {"inspect", "process"}) {
    Words words{command, rec};
    if (words[0] == "process") words.insert(words.end(), {"-o", out});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 1) << command;
    EXPECT_THAT(outcome.err, HasSubstr("tracker.csv:2: column 'pz_m'")) << command;
    EXPECT_THAT(outcome.out, IsEmpty());
  }
  EXPECT_EQ(run({"simulate", "--surface", "velvet", "-o", out}).code, 2);
  EXPECT_EQ(run({"simulate", "--surface", (dir / "absent.csv").string(), "-o", out}).code, 1);
  EXPECT_EQ(run({"simulate", "--surface", "sine", "--seed", "-1", "-o", out}).code, 2);
  EXPECT_EQ(run({"process", rec, "-o", out, "--method", "guess"}).code, 2);
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(entries(dir.path()), 1u);
}

TEST(Spine, InspectSpeaksToPeopleAndPrograms) {
  const testkit::TempDir dir;
  ASSERT_EQ(simulate(dir / "rec", "sine", 1, kShort).code, 0);
  const std::string rec = (dir / "rec").string();
  const Outcome text = run({"inspect", rec});
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.out, HasSubstr("probe"));
  EXPECT_TRUE(nlohmann::json::parse(run({"inspect", rec, "--json"}).out, nullptr, false).is_object());
  EXPECT_THAT(run({"inspect", rec, "--quiet"}).out, IsEmpty());
}

TEST(Spine, ImportMakesARecording) {
  const testkit::TempDir dir;
  std::string imu = "t_s,ax_mps2,ay_mps2,az_mps2,gx_radps,gy_radps,gz_radps\n";
  std::string pose = "t_s,px_m,py_m,pz_m,qw,qx,qy,qz\n";
  for (int i = 0; i < 400; ++i) {
    imu += std::to_string(i * 0.004) + ",0,0,9.81,0,0,0\n";
    pose += std::to_string(i * 0.004) + "," + std::to_string(0.01 * std::sin(0.02 * i)) + ",0,0,1,0,0,0\n";
  }
  write_text(dir / "imu.csv", imu);
  write_text(dir / "pose.csv", pose);
  const Words words{
      "import", "--imu",        (dir / "imu.csv").string(), "--pose", (dir / "pose.csv").string(), "--pose-rate",
      "50",     "--pose-noise", "0.1mm,0.1mm,0.2mm",        "-o",     (dir / "rec").string()};
  EXPECT_EQ(run(words).code, 0);
  const Outcome inspected = run({"inspect", (dir / "rec").string(), "--json"});
  EXPECT_EQ(inspected.code, 0) << inspected.err;
  Words bad = words;
  bad[8] = "0.1mm,0.1mm";
  EXPECT_EQ(run(bad).code, 2);
  bad[8] = "0.1,0.1,0.2";
  EXPECT_EQ(run(bad).code, 2);
}

TEST(Spine, TheDemoPrintsMeasuredAgainstTrue) {
  const testkit::TempDir dir;
  const std::string out = (dir / "demo").string();
  const Outcome outcome = run({"demo", "-o", out});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* word : {"measured", "true", "pitch", "depth", "Rq", "contact stiffness", "correlation", "protoboard",
                           "sandpaper", "pebble", "pose, its points", "undetermined", "painted"}) {
    EXPECT_THAT(outcome.out, HasSubstr(word));
  }
  EXPECT_TRUE(fs::exists(dir / "demo" / "results" / "protoboard" / "texture.json"));
  EXPECT_EQ(run({"inspect", (dir / "demo" / "recordings" / "sandpaper").string()}).code, 0);
  const auto before = contents(out);
  const Outcome again = run({"demo", "-o", out, "--json"});
  EXPECT_EQ(again.code, 0);
  const auto json = nlohmann::json::parse(again.out);
  EXPECT_GT(json["surfaces"]["protoboard"]["correlation"]["measured"].get<double>(), 0.93);
  EXPECT_EQ(contents(out), before);

  // From 5 mm and 5 degrees off, to within four of its own standard deviations and the tip's calibration (0.17 mm).
  const auto& pose = json["mesh"]["registration"];
  EXPECT_LT(pose["pose_m"]["measured"].get<double>(), 4.0 * pose["pose_m"]["stderr"].get<double>() + 0.2e-3);
  EXPECT_LT(pose["turn_rad"]["measured"].get<double>(), 0.03);
  EXPECT_GT(pose["correlation"]["measured"].get<double>(), 0.9);
  EXPECT_GT(json["mesh"]["painted"]["triangles"].get<int>(), 100);
  for (const char* file : {"textured.obj", "scene.json", "registration.json", "profile.csv"}) {
    EXPECT_TRUE(fs::exists(dir / "demo" / "results" / "pebble" / file)) << file;
  }
  std::ifstream scene(dir / "demo" / "painted" / "scene.json");
  EXPECT_EQ(nlohmann::json::parse(scene)["textures"].size(), 2u);
  // What it left serves the other commands.
  const std::string mesh = (dir / "demo" / "pebble.obj").string();
  std::ifstream found(dir / "demo" / "results" / "pebble" / "registration.json");
  const auto pose_found = nlohmann::json::parse(found)["T_mesh_world"];
  std::string guess;
  for (const auto& number : pose_found) guess += (guess.empty() ? "" : ",") + number.dump();
  const Outcome registered = run({"register", (dir / "demo" / "recordings" / "pebble").string(), mesh, "--mesh-unit",
                                  "mm", "--guess", guess, "-o", (dir / "found").string(), "--json"});
  EXPECT_EQ(registered.code, 0) << registered.err;
  EXPECT_EQ(run({"export", (dir / "demo" / "painted").string(), "--to", "stl", "-o", (dir / "stl").string()}).code, 0);

  // The holes' pitch, read back from the force that a modelled hand was given.
  const auto& pitch = json["feel"]["pitch_m"];
  EXPECT_EQ(pitch["true"], 2.5e-3);
  EXPECT_NEAR(pitch["measured"].get<double>(), 2.5e-3, 0.01 * 2.5e-3);
  EXPECT_THAT(outcome.out, HasSubstr("pitch, from the force"));
  EXPECT_TRUE(fs::exists(dir / "demo" / "felt" / "force.svg"));
  EXPECT_GT(json["mesh"]["renderer_check"]["correlation"]["measured"].get<double>(), 0.98);

  // What was registered can be repeated by the renderer, with the scan's own heights and what they make of a force.
  const Words repeat{
      "feel", (dir / "found").string(),   "--replay", (dir / "demo" / "recordings" / "pebble").string(), "--json",
      "-o",   (dir / "repeated").string()};
  const Outcome repeated = run(repeat);
  EXPECT_EQ(repeated.code, 0) << repeated.err;
  const auto score = nlohmann::json::parse(repeated.out)["renderer_check"];
  EXPECT_GT(score["correlation"].get<double>(), 0.97);
  EXPECT_NEAR(score["gain"].get<double>(), 1.0, 0.05);
  EXPECT_GT(score["score"].get<double>(), 0.85);
  EXPECT_TRUE(score["phase_known"].get<bool>());
  const auto first = contents(dir / "repeated");
  EXPECT_EQ(first.size(), 3u);  // files.json, log.csv, result.json
  EXPECT_EQ(run(repeat).code, 0);
  EXPECT_EQ(contents(dir / "repeated"), first);
}

class Interrupted : public ::testing::TestWithParam<int> {};

// Twenty metres of sandpaper, the most the bench takes, keep the program busy for far longer than the signal takes.
TEST_P(Interrupted, LeavesNothingHalfWritten) {
  const testkit::TempDir dir;
  ASSERT_EQ(simulate(dir / "rec", "sine", 1, kShort).code, 0);
  const auto before = contents(dir / "rec");
  for (const char* target : {"rec", "new"}) {
    const Outcome outcome =
        run_and_meddle({"simulate", "--surface", "sandpaper", "--set", "hand.length_m=9.9", "--set",
                        "hand.path=back_and_forth", "--set", "hand.strokes=2", "-o", (dir / target).string()},
                       [&](pid_t process) {
                         EXPECT_TRUE(wait_until_begun(dir / target));
                         std::this_thread::sleep_for(std::chrono::milliseconds(100));  // into the scan
                         ::kill(process, GetParam());
                       });
    EXPECT_EQ(outcome.code, 128 + GetParam());
    if (GetParam() != SIGKILL) {
      EXPECT_THAT(outcome.err, HasSubstr("nothing was written"));
    }
  }
  EXPECT_EQ(contents(dir / "rec"), before);
  EXPECT_FALSE(fs::exists(dir / "new"));
  if (GetParam() != SIGKILL) {
    EXPECT_EQ(entries(dir.path()), 1u) << "temporary folders are gone";
  }
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupted, ::testing::Values(SIGINT, SIGTERM, SIGHUP, SIGKILL));

// Killed wherever it happens to be, the old result or the new one is there, whole.
TEST(Spine, KilledWhileWritingTheResultIsOldOrNew) {
  const testkit::TempDir dir;
  ASSERT_EQ(simulate(dir / "rec", "sine", 1).code, 0);
  const Words words{"process", (dir / "rec").string(), "-o", (dir / "out").string()};
  ASSERT_EQ(run(words).code, 0);
  const auto renewed = contents(dir / "out");
  Words thesis = words;
  thesis.insert(thesis.end(), {"--method", "thesis"});
  const int code = run(thesis).code;
  ASSERT_TRUE(code == 0 || code == 3);
  const auto old = contents(dir / "out");
  ASSERT_NE(old, renewed);
  for (int delay_ms = 5; delay_ms < 200; delay_ms += 15) {
    run_and_signal(words, SIGKILL, std::chrono::milliseconds(delay_ms));
    const auto now = contents(dir / "out");
    ASSERT_TRUE(now == old || now == renewed) << "after " << delay_ms << " ms";
  }
}

TEST(Spine, NoProgressWhereStandardErrorIsNoTerminal) {
  const testkit::TempDir dir;
  EXPECT_THAT(simulate(dir / "rec", "sine", 1).err, IsEmpty());
}

}  // namespace
}  // namespace asperity::cli
