// Power cuts. A command runs with every call noted that changes the disk; then what each prefix of these calls would
// leave is made, with what was not forced to the disk lost, kept, or kept in part and out of order. POWER_STRIDE takes
// every so manieth prefix only; scripts/check takes all.
#include "power_cut.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/recover_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "live_rig.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using Part = PowerCut::Part;

std::size_t stride() {
  const char* text = ::getenv("POWER_STRIDE");
  return text == nullptr ? 9 : static_cast<std::size_t>(std::max(1, std::atoi(text)));
}

// The numbers of calls that are tried: every so manieth, and all.
std::vector<std::size_t> prefixes(std::size_t first, std::size_t calls) {
  std::vector<std::size_t> out;
  for (std::size_t count = first; count < calls; count += stride()) out.push_back(count);
  out.push_back(calls);
  return out;
}

Tree tree_below(const fs::path& folder) {
  Tree out;
  for (const auto& [name, content] : contents(folder)) out[name] = content;
  return out;
}

// What waits for its rename, by a name that says so, is nobody's result.
Tree without_temporaries(Tree tree) {
  std::erase_if(tree, [](const auto& one) {
    return one.first.substr(0, one.first.find('/')).find(".tmp-") != std::string::npos;
  });
  return tree;
}

// Seven disks after the same calls: of what is not certain nothing, all, only names, only bytes, and three random
// parts.
constexpr int kDisks = 7;
Tree disk(const PowerCut& cut, std::size_t count, int which) {
  Random random(1000 * count + static_cast<std::uint64_t>(which));
  return cut.after(count, [&](Part part, std::size_t) {
    switch (which) {
      case 0:
        return false;
      case 1:
        return true;
      case 2:
        return part == Part::kNames;
      case 3:
        return part == Part::kBytes;
      default:
        return random.uniform() < 0.5;
    }
  });
}

class PowerCuts : public testing::Test {
 protected:
  PowerCuts() { fs::create_directories(dir_ / "work"); }
  fs::path work() const { return fs::canonical(dir_ / "work"); }

  // Runs what `program` does with the calls noted, and holds that the calls, played whole, leave what it left.
  PowerCut note(const std::function<void()>& program) {
    const Tree before = tree_below(work());
    const fs::path log = dir_ / "log";
    fs::remove(log);
    const std::map<std::string, std::string> settings{
        {"LD_PRELOAD", POWER_SHIM}, {"POWER_ROOT", work().string()}, {"POWER_LOG", log.string()}};
    for (const auto& [name, value] : settings) ::setenv(name.c_str(), value.c_str(), 1);
    program();
    for (const auto& [name, value] : settings) ::unsetenv(name.c_str());
    PowerCut cut(read_disk_log(log), work(), before);
    EXPECT_GT(cut.calls(), 3u);
    EXPECT_EQ(disk(cut, cut.calls(), 1), tree_below(work())) << "the log lacks a call";
    return cut;
  }

  // At every moment what was there before or what comes, whole; at the end what comes.
  void expect_old_or_new(const PowerCut& cut, const Tree& before, const std::string& what) {
    const Tree after = tree_below(work());
    ASSERT_NE(before, after);
    std::size_t tried = 0, old = 0;
    for (const std::size_t count : prefixes(0, cut.calls())) {
      for (int which = 0; which < kDisks; ++which, ++tried) {
        const Tree now = without_temporaries(disk(cut, count, which));
        const bool is_old = now == before;
        old += is_old;
        EXPECT_TRUE(now == after || (is_old && count < cut.calls()))
            << what << ": after call " << count << " of " << cut.calls() << ", disk " << which
            << ": neither old nor new";
      }
    }
    std::printf("%s: %zu power cuts over %zu calls, %zu left the old\n", what.c_str(), tried, cut.calls(), old);
  }

  testkit::TempDir dir_;
};

// The model itself, by hand: a file that replaces another without a sync is empty or torn, with both it is whole.
TEST_F(PowerCuts, LoseWhatWasNotForcedToTheDisk) {
  const Tree before{{"a", "old"}};
  std::vector<DiskCall> calls{
      {"new", "1:1", "/r/t", "", 0, ""}, {"write", "1:1", "", "", 0, "new"}, {"name", "", "/r/t", "/r/a", 0, ""}};
  const PowerCut careless(calls, "/r", before);
  EXPECT_EQ(disk(careless, 3, 0), before);
  EXPECT_EQ(disk(careless, 3, 1), (Tree{{"a", "new"}}));
  EXPECT_EQ(disk(careless, 3, 2), (Tree{{"a", ""}}));
  calls.insert(calls.begin() + 2, {"sync", "1:1", "/r/t", "", 0, ""});
  calls.push_back({"sync", "1:9", "/r", "", 0, ""});
  const PowerCut careful(calls, "/r", before);
  EXPECT_EQ(disk(careful, 4, 2), (Tree{{"a", "new"}}));
  EXPECT_EQ(disk(careful, 4, 0), before);
  for (int which = 0; which < kDisks; ++which) EXPECT_EQ(disk(careful, 5, which), (Tree{{"a", "new"}}));
}

TEST_F(PowerCuts, OfProcessLeaveOldOrNew) {
  ASSERT_EQ(
      run({"simulate", "--surface", "sine", "--seed", "1", "--set", "hand.length_m=0.012", "-o", dir_ / "rec"}).code,
      0);
  for (const bool replaces : {false, true}) {
    const Tree before = tree_below(work());
    const Words words{"process", dir_ / "rec",
                      "--set",   replaces ? "profile.cutoff_cycles_per_mm=0.2" : "profile.cutoff_cycles_per_mm=0.1",
                      "-o",      work() / "out"};
    const PowerCut cut = note([&] {
      const Outcome outcome = run(words);
      EXPECT_TRUE(outcome.code == 0 || outcome.code == 3) << outcome.err;
    });
    expect_old_or_new(cut, before, replaces ? "process, replacing" : "process, new");
  }
}

TEST_F(PowerCuts, OfACalibrationLeaveOldOrNew) {
  for (const char* rows : {"48,0\n95,1.14\n100,1.24\n105,1.34\n115,1.54\n128,1.79\n155,2.29\n161,2.44\n",
                           "48,0\n95,1.2\n100,1.3\n105,1.4\n115,1.6\n128,1.9\n155,2.4\n161,2.5\n"}) {
    write_text(dir_ / "force.csv", std::string("counts,force_N\n") + rows);
    const Tree before = tree_below(work());
    const PowerCut cut = note([&] {
      const Outcome outcome = run({"calibrate", "force", dir_ / "force.csv", "-o", work() / "calibration.json"});
      EXPECT_LT(outcome.code, 4) << outcome.err;
    });
    expect_old_or_new(cut, before, "calibrate force");
  }
}

// The studio's document, saved five times: each is there once the next begins.
TEST_F(PowerCuts, OfTheStudiosDocumentLeaveOldOrNew) {
  const std::string file = (work() / ".asperity-studio.json").string();
  const std::string program = SAVE_DOCUMENT;
  for (int save = 1; save <= 5; ++save) {
    const Tree before = tree_below(work());
    const PowerCut cut =
        note([&] { EXPECT_EQ(std::system((program + " " + file + " " + std::to_string(save)).c_str()), 0); });
    expect_old_or_new(cut, before, "document, save " + std::to_string(save));
  }
}

// The rows of a stream that are certain: whole lines before the last sync of the file, if its name is certain too.
std::size_t whole_rows(const Tree& tree, const std::string& name) {
  const auto found = tree.find(name);
  if (found == tree.end()) return 0;
  return static_cast<std::size_t>(
      std::max<std::ptrdiff_t>(0, std::count(found->second.begin(), found->second.end(), '\n') - 1));
}

TEST_F(PowerCuts, OfRecordKeepWhatWasForcedToTheDisk) {
  write_live_calibration(dir_ / "calibration.json");
  const PowerCut cut = [&] {
    const LiveProbe probe;
    const LivePoses poses(dir_ / "poses");
    return note([&] {
      const Outcome outcome = run({"record", "--probe", "serial:" + probe.port(), "--poses",
                                   "pipe:" + (dir_ / "poses").string(), "--calibration", dir_ / "calibration.json",
                                   "--duration", "2s", "--set", "recorder.sync_s=0.3", "-o", work() / "rec"});
      EXPECT_EQ(outcome.code, 0) << outcome.err;
    });
  }();
  const std::size_t all = whole_rows(tree_below(work()), "rec/probe.csv");
  ASSERT_GT(all, 100u);  // a busy machine takes a part of the two seconds to begin
  std::size_t tried = 0, recovered = 0, steps = 0, certain_before = 0;
  for (const std::size_t count : prefixes(1, cut.calls())) {
    const Tree certain = disk(cut, count, 0);
    const std::size_t probe_rows = whole_rows(certain, "rec/probe.csv"), poses = whole_rows(certain, "rec/tracker.csv");
    EXPECT_GE(probe_rows, certain_before) << "what was certain is not any more";
    steps += probe_rows > certain_before;
    certain_before = probe_rows;
    if (probe_rows < 2 || poses < 1) continue;
    for (int which = 0; which < kDisks; ++which, ++tried) {
      const testkit::TempDir left;
      for (const auto& [name, content] : disk(cut, count, which)) {
        fs::create_directories((left / name).parent_path());
        if (!name.ends_with('/')) write_text(left / name, content);
      }
      const std::string where = "after call " + std::to_string(count) + " of " + std::to_string(cut.calls()) +
                                ", disk " + std::to_string(which) + ": ";
      try {
        const Recording recording = read_recording(left / "rec");
        EXPECT_GE(recording.probe.size(), probe_rows) << where;
        EXPECT_GE(recording.tracker.size(), poses) << where;
      } catch (const Error& error) {  // holes where bytes were lost behind what is certain
        fs::create_directories(left / "saved");
        RecoverOptions options;
        options.keep_changed = true;
        try {
          const RecoveredRecording saved = recover_recording(left / "rec", left / "saved", options);
          EXPECT_GE(saved.probe.rows, probe_rows) << where;
          EXPECT_GE(saved.tracker.rows, poses) << where;
          ++recovered;
        } catch (const Error& second) {
          ADD_FAILURE() << where << error.what() << "; recover: " << second.what();
        }
      }
    }
  }
  // Every 0.3 s, and at the end.
  EXPECT_EQ(certain_before, all);
  std::printf("record: %zu power cuts over %zu calls, rows became certain in %zu steps, %zu needed recover\n", tried,
              cut.calls(), steps, recovered);
}

}  // namespace
}  // namespace asperity::cli
