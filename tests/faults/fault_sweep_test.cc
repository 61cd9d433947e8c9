// Every call of a command that writes fails once (EIO), or all from one on (a full disk), and memory runs out once.
// Whatever happens, the program must not crash, what was there must be there whole, old or new, and what the program
// says must be so. FAULT_STRIDE takes every so manieth position only; scripts/check takes all.
#include <gmock/gmock.h>
#include <stdlib.h>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "asperity/testkit/temp_dir.h"
#include "live_rig.h"
#include "plane_obj.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using Contents = std::vector<std::pair<std::string, std::string>>;
using testing::HasSubstr;

long number_from(const char* variable, long otherwise) {
  const char* text = ::getenv(variable);
  return text == nullptr ? otherwise : std::atol(text);
}

struct Calls {
  long io = 0, memory = 0;
};

// The program under the shim, with calls below `root` counted, and one of them failing.
class Shimmed {
 public:
  explicit Shimmed(const fs::path& root) : root_(fs::canonical(root)), counts_(root / "counts") {}

  Outcome run_with(const Words& words, const std::map<std::string, std::string>& settings) {
    std::map<std::string, std::string> all = settings;
    all["LD_PRELOAD"] = FAULT_SHIM;
    all["FAULT_ROOT"] = (root_ / "work").string();
    all["FAULT_COUNTS"] = counts_.string();
    for (const auto& [name, value] : all) ::setenv(name.c_str(), value.c_str(), 1);
    const Outcome outcome = run(words);
    for (const auto& [name, value] : all) ::unsetenv(name.c_str());
    return outcome;
  }
  Calls calls() const {
    Calls out;
    std::ifstream(counts_) >> out.io >> out.memory;
    return out;
  }

 private:
  fs::path root_, counts_;
};

// A command that writes to `work/out`, and how its results of another time came to be.
struct Writer {
  const char* name;
  Words words;                  // @ stands for the folder of the inputs, # for the output
  Words before;                 // the same with other settings; empty: the output is never replaced
  const char* start = nullptr;  // of the inputs, the folder that is the output when the command begins
};

void PrintTo(const Writer& writer, std::ostream* out) { *out << writer.name; }

const std::vector<Writer>& writers() {
  static const std::vector<Writer> all{
      {"simulate",
       {"simulate", "--surface", "sine", "--seed", "5", "--set", "hand.length_m=0.01", "-o", "#"},
       {"simulate", "--surface", "sine", "--seed", "6", "--set", "hand.length_m=0.01", "-o", "#"}},
      {"process",
       {"process", "@/rec", "-o", "#"},
       {"process", "@/rec", "--set", "profile.cutoff_cycles_per_mm=0.2", "-o", "#"}},
      {"recover", {"recover", "@/rec", "-o", "#"}, {}},
      {"paint",
       {"paint", "@/plane.obj", "--through", "5,7,0;35,7,0", "--texture", "@/wave.texture.json", "--mesh-unit", "mm",
        "-o", "#"},
       {"paint", "@/plane.obj", "--through", "5,9,0;35,7,0", "--texture", "@/wave.texture.json", "--mesh-unit", "mm",
        "-o", "#"}},
      {"register",
       {"register", "@/path.csv", "@/plane.obj", "--mesh-unit", "mm", "--guess", "0,0,0,1,0,0,0", "-o", "#"},
       {"register", "@/path.csv", "@/plane.obj", "--mesh-unit", "mm", "--guess", "0,0,0.0001,1,0,0,0", "-o", "#"}},
      {"register_into",
       {"register", "@/path.csv", "--into", "#/scene.json", "--guess", "0,0,0,1,0,0,0", "--keep-invalid"},
       {},
       "painted"},
      {"export", {"export", "@/painted", "--to", "gltf", "-o", "#"}, {}},
      {"texture_fit",
       {"texture", "fit", "@/processed/profile.csv", "-o", "#.texture.json"},
       {"texture", "fit", "@/processed/profile.csv", "--name", "another", "-o", "#.texture.json"}},
      {"calibrate_force", {"calibrate", "force", "@/force.csv", "-o", "#.json"}, {}},
  };
  return all;
}

constexpr const char* kTexture =
    R"({"format":"asperity-texture","version":1,"name":"wave","model":"fourier1d",)"
    R"("fourier1d":{"length_mm":10,"omega_rad_per_mm":0.6283185307179586,"a_m":[0,0,0,0.0001],"b_m":[0,0,0,0],"mean_m":0},)"
    R"("extra":{}})";

// What the commands read; made once.
const fs::path& inputs() {
  static const testkit::TempDir dir;
  static const fs::path path = [] {
    const fs::path folder = dir.path();
    run({"simulate", "--surface", "sine", "--seed", "1", "--set", "hand.length_m=0.02", "-o", folder / "rec",
         "--quiet"});
    run({"process", folder / "rec", "-o", folder / "processed", "--quiet"});
    write_text(folder / "plane.obj", plane_obj());
    write_text(folder / "wave.texture.json", kTexture);
    std::string points = "px_m,py_m,pz_m\n";
    for (int i = 0; i < 60; ++i)
      points += std::to_string(0.005 + 0.0005 * i) + "," + std::to_string(0.007 + 0.0001 * (i % 20)) + ",0\n";
    write_text(folder / "path.csv", points);
    write_text(folder / "force.csv",
               "counts,force_N\n48,0\n95,1.14\n100,1.24\n105,1.34\n115,1.54\n128,1.79\n155,2.29\n161,2.44\n185,3.54\n");
    run({"paint", folder / "plane.obj", "--through", "5,7,0;35,7,0", "--texture", folder / "wave.texture.json",
         "--mesh-unit", "mm", "-o", folder / "painted", "--quiet"});
    return folder;
  }();
  return path;
}

Words with_places(Words words, const fs::path& out) {
  for (std::string& word : words) {
    if (word.starts_with('@')) word = inputs().string() + word.substr(1);
    if (word.starts_with('#')) word = out.string() + word.substr(1);
  }
  return words;
}

void restore(const fs::path& folder, const fs::path& from) {
  fs::remove_all(folder);
  fs::copy(from, folder, fs::copy_options::recursive);
}

class Faults : public testing::TestWithParam<Writer> {
 protected:
  Faults() {
    begin();
    fs::create_directories(dir_ / "before");
  }
  // As it is before the command.
  void begin() {
    fs::remove_all(work());
    fs::create_directories(work());
    if (GetParam().start != nullptr) fs::copy(inputs() / GetParam().start, work() / "out", fs::copy_options::recursive);
  }
  fs::path work() const { return dir_ / "work"; }

  // What one run left, held against what was there and what would come. Libraries of others abort where memory runs out
  // (CLI11 in a noexcept function, Eigen 3.4 by freeing twice after a resize that failed): then the old is whole, and a
  // temporary folder may stay.
  void judge(const Outcome& outcome, const Contents& before, const Contents& after, int done_code,
             const std::string& where, bool may_abort = false) {
    const bool aborted = may_abort && outcome.code == 128 + SIGABRT;
    const Contents now = contents(work());
    Contents named;
    for (const auto& [name, text] : now) {
      const std::string top = name.substr(0, name.find('/'));
      if (top.find(".tmp-") == std::string::npos) {
        named.emplace_back(name, text);
      } else if (!aborted) {
        EXPECT_THAT(outcome.err, HasSubstr(top)) << where << ": left behind";
      }
    }
    if (aborted) {
      ++aborts_;
      std::printf("aborted: %s: %s\n", where.c_str(), outcome.err.c_str());
      EXPECT_TRUE(named == before || named == after) << where << ": neither old nor new: " << outcome.err;
      return;
    }
    EXPECT_LT(outcome.code, 128) << where << ": " << outcome.err;
    if (outcome.code == done_code) {
      EXPECT_TRUE(named == after) << where << ": said that it was done: " << outcome.err;
      return;
    }
    EXPECT_FALSE(outcome.err.empty()) << where;
    const auto says_written = testing::AnyOf(HasSubstr("is written"), HasSubstr("written before stays"));
    if (named == before) {
      EXPECT_THAT(outcome.err, testing::Not(says_written)) << where;
      return;
    }
    EXPECT_TRUE(named == after) << where << ": neither old nor new: " << outcome.err;
    EXPECT_THAT(outcome.err, says_written) << where;
  }

  long aborts_ = 0;
  testkit::TempDir dir_;
};

TEST_P(Faults, OldOrNewIsWholeAndToldSo) {
  const Writer& writer = GetParam();
  const long stride = number_from("FAULT_STRIDE", 3);
  Shimmed program(dir_.path());
  const Words words = with_places(writer.words, work() / "out");
  const Outcome reference = program.run_with(words, {});
  ASSERT_TRUE(reference.code == 0 || reference.code == 3) << reference.err;
  const Contents after = contents(work());
  ASSERT_FALSE(after.empty());

  long tried = 0;
  for (const bool replaces : {false, true}) {
    if (replaces && writer.before.empty()) continue;
    begin();
    if (replaces) {
      const Outcome made = run(with_places(writer.before, work() / "out"));
      ASSERT_TRUE(made.code == 0 || made.code == 3) << made.err;
    }
    const Contents before = contents(work());
    if (replaces) {
      ASSERT_TRUE(before != after);
    }
    restore(dir_ / "before", work());
    program.run_with(words, {});
    const long calls = program.calls().io;
    ASSERT_GT(calls, 0);
    for (long at = 1; at <= calls; at += stride) {
      for (const bool full_disk : {false, true}) {
        restore(work(), dir_ / "before");
        std::map<std::string, std::string> settings{{"FAULT_AT", std::to_string(at)}};
        if (full_disk) settings["FAULT_FROM"] = "1";
        const Outcome outcome = program.run_with(words, settings);
        judge(outcome, before, after, reference.code,
              std::string(writer.name) + (replaces ? ", replacing" : ", new") +
                  (full_disk ? ", full from call " : ", call ") + std::to_string(at) + " of " + std::to_string(calls));
        ++tried;
      }
    }
  }
  std::printf("%s: %ld faults of disk calls\n", writer.name, tried);
}

// FAULT_MEMORY positions: two thirds one after the other from the first, where there are 1000, the others spread over
// what comes when the program has started: its start has most of a short command's allocations.
TEST_P(Faults, MemoryThatRunsOut) {
  const Writer& writer = GetParam();
  const long wanted = number_from("FAULT_MEMORY", 12);
  Shimmed program(dir_.path());
  const Words words = with_places(writer.words, work() / "out");
  const Outcome reference = program.run_with(words, {});
  const long calls = program.calls().memory;
  ASSERT_GT(calls, 100);
  program.run_with({writer.words.front()}, {});  // ends with what is missing in its words
  const long started = program.calls().memory;
  ASSERT_LT(started, calls);
  const Contents after = contents(work());
  begin();
  const Contents before = contents(work());
  restore(dir_ / "before", work());
  std::vector<long> positions;
  if (wanted >= 1000) {
    for (long at = 1; at <= wanted * 2 / 3; ++at) positions.push_back(at);
  }
  const long spread = wanted - static_cast<long>(positions.size());
  for (long k = 0; k < spread; ++k) positions.push_back(started + (calls - started) * k / spread);
  long told = 0, unharmed = 0;
  for (const long at : positions) {
    restore(work(), dir_ / "before");
    const Outcome outcome = program.run_with(words, {{"FAULT_MALLOC", std::to_string(at)}});
    judge(outcome, before, after, reference.code,
          std::string(writer.name) + ", allocation " + std::to_string(at) + " of " + std::to_string(calls), true);
    (outcome.code == reference.code ? unharmed : told) += 1;
  }
  EXPECT_LE(10 * aborts_, told + unharmed + 10) << "more than the libraries' few";
  std::printf("%s: %ld faults of memory, %ld told, %ld aborted in a library, %ld without harm\n", writer.name,
              told + unharmed, told - aborts_, aborts_, unharmed);
}

INSTANTIATE_TEST_SUITE_P(Commands, Faults, testing::ValuesIn(writers()),
                         [](const auto& one) { return std::string(one.param.name); });

// A take that the disk ends keeps what came before, and says that it was ended.
TEST(RecordFaults, ATakeKeepsWhatCameBefore) {
  const testkit::TempDir dir;
  fs::create_directories(dir / "work");
  write_live_calibration(dir / "calibration.json");
  {
    const LiveProbe probe;
    const LivePoses poses(dir / "poses");
    const Outcome live = run({"record", "--probe", "serial:" + probe.port(), "--poses",
                              "pipe:" + (dir / "poses").string(), "--calibration", dir / "calibration.json",
                              "--capture", dir / "probe.bin", "--duration", "1s", "-o", dir / "live"});
    ASSERT_EQ(live.code, 0) << live.err;
  }
  const Words words{"record",
                    "--probe",
                    "file:" + (dir / "probe.bin").string(),
                    "--poses",
                    "file:" + (dir / "live/tracker.csv").string(),
                    "--calibration",
                    dir / "calibration.json",
                    "--set",
                    "recorder.sync_s=0.1",
                    "-o",
                    dir / "work/rec"};
  Shimmed program(dir.path());
  const Outcome reference = program.run_with(words, {});
  ASSERT_TRUE(reference.code == 0 || reference.code == 3) << reference.err;
  std::ifstream whole_rows(dir / "work/rec/probe.csv");
  const std::string whole_text{std::istreambuf_iterator<char>(whole_rows), {}};
  ASSERT_GT(whole_text.size(), 10'000u);
  std::size_t most_kept = 0;
  const long calls = program.calls().io, stride = number_from("FAULT_STRIDE", 3);
  ASSERT_GT(calls, 5);
  for (long at = 1; at <= calls; at += stride) {
    fs::remove_all(dir / "work");
    fs::create_directories(dir / "work");
    const Outcome outcome = program.run_with(words, {{"FAULT_AT", std::to_string(at)}});
    const std::string where = "call " + std::to_string(at) + " of " + std::to_string(calls) + ": " + outcome.err;
    EXPECT_LT(outcome.code, 128) << where;
    // The number of calls differs from run to run by the disk's pace: behind the last nothing fails.
    if (program.calls().io < at) continue;
    EXPECT_NE(outcome.code, 0) << where;
    EXPECT_FALSE(outcome.err.empty()) << where;
    if (!fs::exists(dir / "work/rec/probe.csv")) continue;
    std::ifstream rows(dir / "work/rec/probe.csv");
    const std::string kept{std::istreambuf_iterator<char>(rows), {}};
    // Whole lines of the take, from its first on; a write that failed may have left a part of the next.
    const std::string lines = kept.substr(0, kept.rfind('\n') + 1);
    EXPECT_TRUE(whole_text.starts_with(lines)) << where;
    most_kept = std::max(most_kept, lines.size());
  }
  EXPECT_GT(most_kept, whole_text.size() / 2) << "the last faults come behind nearly all";
  std::printf("record: %ld faults of disk calls\n", (calls + stride - 1) / stride);
}

}  // namespace
}  // namespace asperity::cli
