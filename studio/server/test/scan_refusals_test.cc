// What the Scan page refuses, and its messages.
#include <gmock/gmock.h>

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "scan_bench.h"

namespace asperity::studio {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(ScanPage, RefusesSettingsThatContradictEachOther) {
  ScanBench bench;
  Json both;
  both["process.profile.spacing_m"] = "0.001";
  both["process.profile.cutoff_cycles_per_mm"] = "5";
  EXPECT_THROW(bench.edit("/scan/settings", both), Error);
  EXPECT_THROW(bench.set("hints.light_N", "50"), Error);
  EXPECT_THROW(bench.set("process.base.contact.release_N", "50"), Error);
  EXPECT_THROW(bench.set("recorder.contact.off_N", "50"), Error);
  EXPECT_NO_THROW(bench.set("hints.light_N", "0.4"));
}

TEST(ScanPage, SaysThatAProbeHasVanished) {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  ASSERT_EQ(::grantpt(terminal), 0);
  ASSERT_EQ(::unlockpt(terminal), 0);
  ScanBench bench;
  bench.edit("/scan/source", "hardware");
  bench.edit("/scan/hardware/probe", std::string("serial:") + ::ptsname(terminal));
  bench.edit("/scan/hardware/protocol", "what");
  bench.edit("/scan/hardware/uncalibrated", true);
  bench.ask("scan.open");
  const unsigned char sample[5] = {0xFF, 128, 129, 130, 40};
  ASSERT_TRUE(bench.wait([&] {
    EXPECT_EQ(::write(terminal, sample, sizeof sample), static_cast<ssize_t>(sizeof sample));
    return bench.recorder().is_object() && bench.recorder().at("probe").at("state") == "running";
  }));
  ::close(terminal);
  ASSERT_TRUE(bench.wait([&] { return bench.recorder().at("probe").at("state") == "lost"; }));
  EXPECT_NE(bench.recorder().at("probe").at("message"), "");
  EXPECT_TRUE(bench.ask("scan.close").at("recording").is_null());
}

TEST(ScanPage, RefusesWhatLeavesTheFolderOrIsNoDevice) {
  ScanBench bench;
  bench.edit("/scan/source", "hardware");
  bench.edit("/scan/hardware/uncalibrated", true);
  for (const char* probe : {"serial:/etc/passwd", "serial:/dev/../etc/passwd", "file:/etc/passwd@1000",
                            "file:../x@1000", "no such thing", ""}) {
    bench.edit("/scan/hardware/probe", probe);
    EXPECT_NE(bench.call("scan.open").error, "") << probe;
  }
  bench.edit("/scan/hardware/probe", "udp:0.0.0.0:1");
  bench.edit("/scan/hardware/uncalibrated", false);
  bench.edit("/scan/hardware/calibration", "../calibration.json");
  EXPECT_NE(bench.call("scan.open").error, "");
  bench.edit("/scan/hardware/calibration", "");
  EXPECT_THAT(bench.call("scan.open").error, HasSubstr("no calibration"));
  bench.edit("/scan/source", "replay");
  EXPECT_THAT(bench.call("scan.open").error, HasSubstr("no recording"));
}

TEST(ScanPage, RefusesASectionThatIsNone) {
  ScanBench bench;
  EXPECT_THROW(bench.edit("/scan/source", "elsewhere"), Error);
  EXPECT_THROW(bench.edit("/scan/name", "../x"), Error);
  EXPECT_THROW(bench.edit("/scan/name", ".hidden"), Error);
  EXPECT_THROW(bench.edit("/scan/auto", 1), Error);
  EXPECT_THROW(bench.edit("/scan/unknown", 1), Error);
  EXPECT_THROW(bench.set("process.nonsense", "1"), Error);
  EXPECT_THROW(bench.set("bench.speed_mps", "-3"), Error);
  EXPECT_THROW(bench.set("recorder.mode", "auto"), Error);  // the switch's
}

TEST(ScanPage, ListsEachSettingOnce) {
  ScanBench bench;
  bench.set("hints.light_N", "0.5");
  const Json fields = bench.ask("scan.fields");
  std::set<std::string> paths;
  for (const Json& field : fields) {
    EXPECT_TRUE(paths.insert(field.at("path").text()).second) << field.at("path");
    if (field.at("path") == "hints.light_N") {
      EXPECT_EQ(field.at("value"), 0.5);
      EXPECT_EQ(field.at("default"), 0.3);
    }
  }
  EXPECT_TRUE(paths.contains("process.profile.cutoff_cycles_per_mm"));
  EXPECT_FALSE(paths.contains("live.profile.cutoff_cycles_per_mm"));
  EXPECT_TRUE(paths.contains("live.min_speed_mps"));
}

}  // namespace
}  // namespace asperity::studio
