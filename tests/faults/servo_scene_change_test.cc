// The servo thread of the studio while the scene under the hand is changed again and again: no allocation, no mapping
// of memory, no lock and no page fault, as for one scene (servo_calls_test.cc).
#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "asperity/testkit/temp_dir.h"
#include "plane_obj.h"
#include "run_asperity.h"
#include "servo_counts.h"
#include "studio_window.h"

namespace asperity::cli {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

// Cosines of 2.5 mm and 0.1 mm height.
constexpr const char* kTexture =
    R"({"format":"asperity-texture","version":1,"name":"wave","model":"fourier1d",)"
    R"("fourier1d":{"length_mm":10,"omega_rad_per_mm":0.6283185307179586,"a_m":[0,0,0,0.0001],"b_m":[0,0,0,0],"mean_m":0},)"
    R"("compliance_kc":1,"extra":{}})";

void pause_ms(int time_ms) { std::this_thread::sleep_for(std::chrono::milliseconds(time_ms)); }

// Waits until another world than `before` is felt, and returns its number.
Json await_other_world(StudioWindow& window, const Json& before) {
  for (const auto end = Clock::now() + std::chrono::seconds(30); Clock::now() < end; pause_ms(10)) {
    const Json status = window.call("feel.status");
    if (status["state"] == "running" && !status["loading"] && status["felt"] != before) return status["felt"];
  }
  ADD_FAILURE() << "the scene was not changed: " << window.call("feel.status").dump();
  return before;
}

// Waits until the servo thread has waited `waits` times more than it has now (servo_shim.c writes that as it counts).
void await_servo(const std::filesystem::path& counts, long waits) {
  const auto end = Clock::now() + std::chrono::seconds(60);
  const long wanted = read_servo_counts(counts).waits + waits;
  while (read_servo_counts(counts).waits < wanted && Clock::now() < end) pause_ms(10);
  EXPECT_GE(read_servo_counts(counts).waits, wanted);
}

constexpr long kWaitsEach = 200;

TEST(ServoSceneChange, NothingThatCouldBlock) {
  const testkit::TempDir dir;
  write_text(dir / "plane.obj", plane_obj());
  write_text(dir / "wave.texture.json", kTexture);
  const Outcome painted = run({"paint", dir / "plane.obj", "--through", "5,7,0;35,7,0", "--texture",
                               dir / "wave.texture.json", "--mesh-unit", "mm", "-o", dir / "scene", "--quiet"});
  ASSERT_EQ(painted.code, 0) << painted.err;
  const std::vector<std::pair<std::string, Json>> changes{
      {"render.friction", 0.2},
      {"render.texture.model", "normal-perturbation"},
      {"render.stiffness_N_per_m", 900.0},
      {"render.texture.model", "lateral-gradient"},
      {"render.friction", 0.3},
      {"render.texture.model", "height"},
  };
  int attempts = 0;
  const auto count = [&] {
    const std::filesystem::path out = dir / ("out" + std::to_string(++attempts));
    std::filesystem::remove(dir / "counts");
    // The studio before has stored its settings, and an edit to the same value changes nothing.
    std::filesystem::remove(dir / ".asperity-studio.json");
    int changed = 0;
    std::string refused, state;
    ::setenv("LD_PRELOAD", SERVO_SHIM, 1);
    ::setenv("SERVO_COUNTS", (dir / "counts").c_str(), 1);
    const auto meddle = [&](pid_t studio) {
      ::unsetenv("LD_PRELOAD");
      ::unsetenv("SERVO_COUNTS");
      try {
        StudioWindow window(out);
        window.edit("/feel/scene", "scene");
        window.edit("/feel/device", "sim");
        window.keep_lease();
        window.call("feel.start");
        await_servo(dir / "counts", 1);  // past the waits that are not counted
        Json felt = window.call("feel.status")["felt"];
        for (const auto& [setting, value] : changes) {
          window.edit("/feel/settings/" + setting, value);
          const Json next = await_other_world(window, felt);
          changed += next != felt ? 1 : 0;
          felt = next;
          while (!window.call("job.list").empty()) pause_ms(10);
          await_servo(dir / "counts", kWaitsEach);  // and it is felt
        }
        state = window.call("feel.status")["state"].get<std::string>();
      } catch (const std::exception& error) {
        refused = error.what();
      }
      ::kill(studio, SIGTERM);
    };
    const Outcome outcome = run_and_meddle({"studio", dir.path().string(), "--no-open"}, meddle, out);
    EXPECT_EQ(refused, "") << outcome.err;
    EXPECT_EQ(changed, static_cast<int>(changes.size()));
    EXPECT_EQ(state, "running");
    return read_servo_counts(dir / "counts");
  };
  expect_no_call_that_could_block(count, kWaitsEach * static_cast<long>(changes.size()));
}

}  // namespace
}  // namespace asperity::cli
