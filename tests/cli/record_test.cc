#include <gmock/gmock.h>
#include <poll.h>
#include <pty.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "asperity/recording/read_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "live_rig.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using ::testing::HasSubstr;
using Words = std::vector<std::string>;

struct Rig {
  testkit::TempDir dir;
  LiveProbe probe;
  LivePoses poses{dir / "poses"};

  Rig() { write_live_calibration(dir / "calibration.json"); }

  // Until four seconds of the probe, in which the status is printed, and of poses are on the disk; a minute at most.
  void wait_for_rows() const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end && (rows("probe.csv") < 4000 || rows("tracker.csv") < 200)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  std::ptrdiff_t rows(const std::string& name) const {
    std::ifstream file(dir / ("rec/" + name));
    return std::count(std::istreambuf_iterator<char>(file), {}, '\n');
  }

  Words words(const Words& more) const {
    Words out{"record",
              "--probe",
              "serial:" + probe.port(),
              "--poses",
              "pipe:" + (dir / "poses").string(),
              "--calibration",
              (dir / "calibration.json").string(),
              "-o",
              (dir / "rec").string()};
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }
};

TEST(Record, FromASerialPortAndAPoseStream) {
  const Rig rig;
  const Outcome outcome = run(rig.words({"--duration", "2s", "--object", "cork", "--json"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["format"], "asperity-recorded");
  EXPECT_EQ(json["end"], "duration");
  EXPECT_EQ(json["segments"], 1);
  EXPECT_EQ(json["link"]["lost_samples"], 0);
  EXPECT_EQ(json["trustworthy"], true);
  EXPECT_EQ(json["gravity"]["measured"], true);
  EXPECT_NEAR(json["gravity"]["gravity_world_mps2"][1].get<double>(), 9.81, 0.01);

  const Recording recording = read_recording(rig.dir / "rec");
  EXPECT_THAT(recording.problems, testing::IsEmpty());
  EXPECT_EQ(recording.info.object, "cork");
  EXPECT_EQ(recording.info.probe_model, "open");
  EXPECT_EQ(recording.info.probe_rate_Hz, 1000.0);
  EXPECT_EQ(json["probe_rows"], recording.probe.size());
  EXPECT_GT(recording.probe.size(), 1000u);
  EXPECT_GT(recording.tracker.size(), 50u);
  EXPECT_EQ(recording.info.recorder.value().state, "finished");

  const auto before = contents(rig.dir / "rec");
  const Outcome again = run(rig.words({"--duration", "1s"}));
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, HasSubstr("not empty"));
  EXPECT_EQ(contents(rig.dir / "rec"), before);
}

TEST(Record, ACaptureGivesTheSameRowsAgain) {
  const Rig rig;
  const std::string capture = rig.dir / "probe.bin";
  const Outcome live = run(rig.words({"--duration", "1s", "--capture", capture}));
  ASSERT_EQ(live.code, 0) << live.err;
  const Outcome replayed =
      run({"record", "--probe", "file:" + capture, "--uncalibrated", "--json", "-o", rig.dir / "again"});
  const ProbeStream first = read_recording(rig.dir / "rec").probe;
  // Without poses it is no recording to process, but its rows are there.
  std::ifstream file(rig.dir / "again/probe.csv");
  const std::string rows{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n')), first.size() + 1)
      << live.err << replayed.err;
  const Outcome twice = run(rig.words({"--duration", "1s", "--capture", capture}));
  EXPECT_EQ(twice.code, 1);
}

TEST(Record, CtrlCEndsWithAWholeRecording) {
  const Rig rig;
  const Outcome outcome = run_and_meddle(rig.words({}), [&](pid_t process) {
    rig.wait_for_rows();
    ::kill(process, SIGINT);
  });
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("probe "));
  EXPECT_THAT(outcome.out, HasSubstr("1 segment"));
  const Recording recording = read_recording(rig.dir / "rec");
  EXPECT_EQ(recording.info.recorder.value().state, "finished");
  EXPECT_THAT(recording.problems, testing::IsEmpty());
}

TEST(Record, AutoStoresTheTouches) {
  Rig rig;
  // For as long as it records: on a busy machine it takes seconds to begin.
  std::atomic<bool> done{false};
  std::thread hand([&] {
    while (rig.probe.press(0.0, 120, done) && rig.probe.press(1.0, 60, done)) {
    }
  });
  const Outcome outcome = run(rig.words({"--auto", "--duration", "6s", "--json", "--set", "recorder.pre_roll_s=0.3",
                                         "--set", "recorder.post_roll_s=0.2"}));
  done = true;
  hand.join();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["touches"], json["segments"]);
  EXPECT_GE(json["segments"], 1);
  EXPECT_LE(json["segments"], 4);  // one each 1.8 s of the 6 s
  const Recording recording = read_recording(rig.dir / "rec");
  EXPECT_EQ(recording.info.segments.back().name, "contact_" + std::to_string(recording.info.segments.size()));
}

TEST(Record, WhatIsNotToBeTrustedEndsWith3) {
  const Rig rig;
  const Outcome touchless = run(rig.words({"--auto", "--duration", "1s", "--json"}));
  EXPECT_EQ(touchless.code, 3);
  EXPECT_THAT(touchless.err, HasSubstr("never touched"));
  EXPECT_EQ(nlohmann::json::parse(touchless.out)["trustworthy"], false);

  const std::string no_poses = (rig.dir / "none").string();
  ASSERT_EQ(::mkfifo(no_poses.c_str(), 0600), 0);
  const Outcome blind =
      run({"record", "--probe", "serial:" + rig.probe.port(), "--poses", "pipe:" + no_poses, "--calibration",
           (rig.dir / "calibration.json").string(), "--duration", "1s", "-o", (rig.dir / "blind").string()});
  EXPECT_EQ(blind.code, 3);
  EXPECT_THAT(blind.err, HasSubstr("pose"));
}

TEST(Record, WrongCommandLines) {
  const testkit::TempDir dir;
  const std::string rec = (dir / "rec").string();
  EXPECT_EQ(run({"record", "-o", rec}).code, 2);
  const Outcome uncalibrated = run({"record", "--probe", "udp:9", "-o", rec});
  EXPECT_EQ(uncalibrated.code, 2);
  EXPECT_THAT(uncalibrated.err, HasSubstr("--uncalibrated"));
  EXPECT_EQ(run({"record", "--probe", "tcp:9", "--uncalibrated", "-o", rec}).code, 2);
  EXPECT_EQ(run({"record", "--probe", "udp:9", "--uncalibrated", "--poses", "vrpn:x", "-o", rec}).code, 2);
  EXPECT_EQ(run({"record", "--probe", "serial:" + rec + "/none", "--uncalibrated", "-o", rec}).code, 1);
  EXPECT_FALSE(std::filesystem::exists(rec));
}

// A dictionary named in the calibration stays in its folder.
TEST(Record, AMarkersFileOutsideIsRefused) {
  const testkit::TempDir dir;
  write_live_calibration(dir / "calibration.json");
  auto calibration = nlohmann::json::parse(std::ifstream(dir / "calibration.json"));
  calibration["camera"] = {{"width", 64}, {"height", 48}, {"fx", 60}, {"fy", 60}, {"cx", 31.5}, {"cy", 23.5}};
  calibration["markers"].push_back(
      {{"id", 0}, {"family", "aruco:../d.yml"}, {"size_m", 0.046}, {"T_marker_tag", {0, 0, 0, 1, 0, 0, 0}}});
  std::ofstream(dir / "calibration.json") << calibration.dump();
  const Outcome outcome = run({"record", "--probe", "udp:9", "--camera", "images:" + dir.path().string(),
                               "--calibration", (dir / "calibration.json").string(), "-o", (dir / "rec").string()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("not in the folder"));
}

// The program on a terminal of its own: what it shows, and keys typed once `text` has been shown.
class Terminal {
 public:
  explicit Terminal(const Words& words) {
    Words all{ASPERITY_BINARY};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> argv;
    for (std::string& word : all) argv.push_back(word.data());
    argv.push_back(nullptr);
    id_ = ::forkpty(&file_, nullptr, nullptr, nullptr);
    if (id_ == 0) {
      ::execv(ASPERITY_BINARY, argv.data());
      ::_exit(127);
    }
  }
  ~Terminal() {
    if (id_ > 0) ::kill(id_, SIGKILL);
    if (id_ > 0) ::waitpid(id_, nullptr, 0);
    ::close(file_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // False if it was not shown from now on within half a minute.
  bool wait_for(const std::string& text) {
    const std::size_t from = shown_.size();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end && shown_.find(text, from) == std::string::npos && read()) {
    }
    return shown_.find(text, from) != std::string::npos;
  }
  void type(char key) { ASSERT_EQ(::write(file_, &key, 1), 1); }
  int wait() {
    while (read()) {
    }
    int status = 0;
    ::waitpid(id_, &status, 0);
    id_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  const std::string& shown() const { return shown_; }

 private:
  bool read() {
    pollfd wait{file_, POLLIN, 0};
    if (::poll(&wait, 1, 30'000) <= 0) return false;
    std::array<char, 4096> buffer;
    const ssize_t count = ::read(file_, buffer.data(), buffer.size());
    if (count <= 0) return false;
    shown_.append(buffer.data(), static_cast<std::size_t>(count));
    return true;
  }

  pid_t id_ = 0;
  int file_ = -1;
  std::string shown_;
};

TEST(Record, KeysStartStopAndDiscardSegments) {
  const Rig rig;
  Terminal terminal(rig.words({}));
  ASSERT_TRUE(terminal.wait_for("space: start or stop")) << terminal.shown();
  ASSERT_TRUE(terminal.wait_for("● segment_1")) << terminal.shown();
  ASSERT_TRUE(terminal.wait_for("2 markers")) << terminal.shown();
  terminal.type(' ');
  ASSERT_TRUE(terminal.wait_for("○ 1 segments")) << terminal.shown();
  terminal.type(' ');
  ASSERT_TRUE(terminal.wait_for("● segment_2")) << terminal.shown();
  terminal.type('d');
  ASSERT_TRUE(terminal.wait_for("○ 1 segments")) << terminal.shown();
  terminal.type('q');
  EXPECT_EQ(terminal.wait(), 0) << terminal.shown();
  EXPECT_THAT(terminal.shown(), HasSubstr("discarded   1"));
  const Recording recording = read_recording(rig.dir / "rec");
  ASSERT_EQ(recording.info.segments.size(), 1u);
  for (const std::int64_t t_ns : recording.probe.t_ns) EXPECT_LE(t_ns, recording.info.segments[0].end_ns);
}

}  // namespace
}  // namespace asperity::cli
