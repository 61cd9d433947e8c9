// Every call of a command on its files fails once (EIO), or all writing ones from one on (a full disk), and memory runs
// out once.
// Whatever happens, the program must not crash, what was there must be there whole, old or new, and what the program
// says must be so. FAULT_STRIDE takes every so manieth position only; scripts/check takes all. A take:
// record_faults_test.cc.
#include <gmock/gmock.h>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/testkit/temp_dir.h"
#include "plane_obj.h"
#include "run_asperity.h"
#include "shimmed.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using Contents = std::vector<std::pair<std::string, std::string>>;
using testing::HasSubstr;

// A command that writes to `work/out`, and how its results of another time came to be.
struct Writer {
  const char* name;
  Words words;                    // @ stands for the folder of the inputs, # for the output
  Words before;                   // the same with other settings; empty: the output is never replaced
  const char* start = nullptr;    // of the inputs, the folder that is the output when the command begins
  const char* program = nullptr;  // another than asperity, whose result depends on what it replaces
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
      {"save_document", {"#.json", "2"}, {"#.json", "1"}, nullptr, SAVE_DOCUMENT},
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
  Faults() : other_program_(other_program()) {
    begin();
    fs::create_directories(dir_ / "before");
  }
  static std::map<std::string, std::string> other_program() {
    if (GetParam().program == nullptr) return {};
    return {{"ASPERITY_OTHER_PROGRAM", GetParam().program}, {"ASPERITY_USE_OTHER", "1"}};
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
    const Contents now = with_names_as_before(contents(work()), outcome);
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

  // The studio puts a document aside that it cannot read, and says so: it is whole under another name.
  static Contents with_names_as_before(Contents now, const Outcome& outcome) {
    constexpr std::string_view kAside = ".unreadable";
    if (outcome.err.find("was renamed to") == std::string::npos) return now;
    for (auto& [name, text] : now) {
      if (name.ends_with(kAside)) name.resize(name.size() - kAside.size());
    }
    return now;
  }

  long aborts_ = 0;
  Variables other_program_;
  testkit::TempDir dir_;
};

TEST_P(Faults, OldOrNewIsWholeAndToldSo) {
  const Writer& writer = GetParam();
  const long stride = number_from("FAULT_STRIDE", 11);
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
    const Contents whole = contents(work());
    ASSERT_TRUE(whole == after || writer.program != nullptr);
    ASSERT_TRUE(whole != before);
    for (long at = 1; at <= calls; at += stride) {
      for (const bool full_disk : {false, true}) {
        restore(work(), dir_ / "before");
        std::map<std::string, std::string> settings{{"FAULT_AT", std::to_string(at)}};
        if (full_disk) settings["FAULT_FROM"] = "1";
        const Outcome outcome = program.run_with(words, settings);
        judge(outcome, before, whole, reference.code,
              std::string(writer.name) + (replaces ? ", replacing" : ", new") +
                  (full_disk ? ", full from call " : ", call ") + std::to_string(at) + " of " + std::to_string(calls));
        ++tried;
      }
    }
  }
  std::printf("%s: %ld faults of disk calls\n", writer.name, tried);
}

// Where two names cannot be exchanged, two renames leave a moment without a result under its name. If the second fails
// and so does the third, back, then the old one is whole under the name that the message gives.
TEST(ExchangeFaults, WithoutAnExchangeOldOrNewIsWholeOrNamed) {
  const testkit::TempDir dir;
  const fs::path work = dir / "work", out = dir / "work/out";
  fs::create_directories(work);
  const Words words = with_places({"process", "@/rec", "-o", "#"}, out);
  ASSERT_LT(run(words).code, 4);
  const Contents after = contents(work);
  ASSERT_LT(run(with_places({"process", "@/rec", "--set", "profile.cutoff_cycles_per_mm=0.2", "-o", "#"}, out)).code,
            4);
  const Contents before = contents(work);
  ASSERT_TRUE(before != after);
  restore(dir / "before", work);
  Shimmed program(dir.path());
  // The trace numbers the calls: those behind the sync of the new folder are the renames and what follows.
  const Outcome traced = program.run_with(words, {{"FAULT_NO_EXCHANGE", "1"}, {"FAULT_TRACE", "1"}});
  EXPECT_TRUE(contents(work) == after) << "two renames replace, too";
  const std::size_t moved = traced.err.find(".old\n");
  ASSERT_NE(moved, std::string::npos) << traced.err;
  const std::size_t line = traced.err.rfind('\n', moved) + 1;
  const long moves = std::atol(traced.err.c_str() + line), calls = program.calls().io;
  ASSERT_GT(moves, 0);
  long lost = 0;
  for (long at = moves; at <= std::min(calls, moves + 5); ++at) {
    for (const bool full_disk : {false, true}) {
      restore(work, dir / "before");
      std::map<std::string, std::string> settings{{"FAULT_NO_EXCHANGE", "1"}, {"FAULT_AT", std::to_string(at)}};
      if (full_disk) settings["FAULT_FROM"] = "1";
      const Outcome outcome = program.run_with(words, settings);
      const std::string where = "call " + std::to_string(at) + " of " + std::to_string(calls) + ": " + outcome.err;
      EXPECT_LT(outcome.code, 128) << where;
      if (fs::exists(out)) {
        Contents now = contents(work);
        std::erase_if(now, [](const auto& one) { return !one.first.starts_with("out/"); });
        EXPECT_TRUE(now == before || now == after) << where;
        if (contents(work) == before || contents(work) == after) continue;
      } else {
        ++lost;
      }
      // What is left beside it is named; where nothing has the result's name it is the old one, whole.
      for (const auto& entry : fs::directory_iterator(work)) {
        const std::string name = entry.path().filename().string();
        if (name == "out") continue;
        EXPECT_THAT(outcome.err, HasSubstr(name)) << where;
        if (fs::exists(out)) continue;
        Contents old;
        for (const auto& [inner, text] : contents(entry.path())) old.emplace_back("out/" + inner, text);
        old.emplace_back("out/", "");
        std::sort(old.begin(), old.end());
        EXPECT_TRUE(old == before) << where;
      }
    }
  }
  EXPECT_EQ(lost, 1) << "of a disk that is full from the second rename on";
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
  ASSERT_GT(calls, 50);
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

}  // namespace
}  // namespace asperity::cli
