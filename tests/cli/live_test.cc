// `asperity simulate --live` as another program sees it: what it announces, plays and leaves behind.

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// The first line of `file` as soon as it is whole; empty after two minutes.
std::string first_line(const fs::path& file) {
  constexpr auto kPatience = std::chrono::minutes(2);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < end) {
    std::ifstream in(file);
    std::string line;
    if (std::getline(in, line) && !in.eof()) return line;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return "";
}

// Markers are found in 30 images a second, but not with every access to memory checked: then only races are looked for.
#if defined(__has_feature)  // clang's
#if __has_feature(address_sanitizer)
#define CHECKS_MEMORY
#endif
#endif
#if defined(__SANITIZE_THREAD__) || defined(CHECKS_MEMORY)
constexpr bool kKeepsUp = false;
#else
constexpr bool kKeepsUp = true;
#endif

TEST(Live, IsRecordedByTheRecorder) {
  const testkit::TempDir folder;
  const std::string scan = folder / "scan";
  const std::string recorded = folder / "recorded";
  Outcome simulated;
  std::jthread bench([&] {
    simulated = run_into(folder / "said", {"simulate", "--live", "--json", "--surface", "protoboard", "--set",
                                           "hand.length_m=0.03", "--set", "live.camera.rate_Hz=30", "--set",
                                           "live.wait_s=120", "--set", "live.linger_s=0.3", "-o", scan});
  });
  const auto said = nlohmann::json::parse(first_line(folder / "said"), nullptr, false);
  ASSERT_TRUE(said.is_object());
  EXPECT_EQ(said["format"], "asperity-live");
  const Outcome outcome = run({"record", "--probe", "serial:" + said["port"].get<std::string>(), "--camera",
                               "y4m:" + said["camera"].get<std::string>(), "--calibration",
                               said["calibration"].get<std::string>(), "--duration", "6s", "--json", "-o", recorded});
  bench.join();
  EXPECT_TRUE(simulated.code == 0 || (!kKeepsUp && simulated.code == 3)) << simulated.code << ": " << simulated.err;
  EXPECT_TRUE(outcome.code == 0 || outcome.code == 3) << outcome.err;
  EXPECT_FALSE(fs::exists(said["camera"].get<std::string>()));
  // The bench's own recording has the truth on the same clock, and what a recorder needs to know.
  for (const char* name : {"truth.csv", "camera.json", "markers.json", "calibration.json"})
    EXPECT_TRUE(fs::exists(fs::path(scan) / name)) << name;
  const Outcome looked = run({"inspect", recorded, "--json"});
  EXPECT_EQ(looked.code, 0) << looked.err;
  const auto lines = [](const fs::path& file) {
    std::ifstream in(file);
    return std::count(std::istreambuf_iterator<char>(in), {}, '\n');
  };
  // A busy machine may end the six seconds early: most must be there.
  EXPECT_GT(2 * lines(fs::path(recorded) / "probe.csv"), lines(fs::path(scan) / "probe.csv"));
  EXPECT_GT((kKeepsUp ? 2 : 50) * lines(fs::path(recorded) / "tracker.csv"), lines(fs::path(scan) / "tracker.csv"));
}

TEST(Live, NobodyComesAndNothingIsLeft) {
  const testkit::TempDir folder;
  const Outcome outcome = run({"simulate", "--live", "--surface", "sine", "--set", "hand.length_m=0.01", "--set",
                               "live.wait_s=0.1", "-o", folder / "scan"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("live.wait_s"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Live, ItsSettingsNeedTheFlag) {
  const testkit::TempDir folder;
  EXPECT_EQ(run({"simulate", "--surface", "sine", "--set", "live.wait_s=1", "-o", folder / "scan"}).code, 2);
  EXPECT_THAT(run({"simulate", "--live", "--surface", "sine", "--print-config"}).out, HasSubstr("[live.camera]"));
}

}  // namespace
}  // namespace asperity::cli
