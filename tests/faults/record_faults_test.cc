// A take whose disk, memory, capture or images fail keeps all that came before, and says so (fault_sweep_test.cc).
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "asperity/testkit/temp_dir.h"
#include "live_rig.h"
#include "run_asperity.h"
#include "shimmed.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using testing::HasSubstr;

// A take of a probe's capture and a tracker's poses, which is played again.
class RecordFaults : public testing::Test {
 protected:
  RecordFaults() {
    begin();
    write_live_calibration(dir_ / "calibration.json");
    const LiveProbe probe;
    const LivePoses poses(dir_ / "poses");
    const Outcome live = run({"record", "--probe", "serial:" + probe.port(), "--poses",
                              "pipe:" + (dir_ / "poses").string(), "--calibration", dir_ / "calibration.json",
                              "--capture", dir_ / "probe.bin", "--duration", "1s", "-o", dir_ / "live"});
    EXPECT_EQ(live.code, 0) << live.err;
  }
  void begin() {
    fs::remove_all(dir_ / "work");
    fs::create_directories(dir_ / "work");
  }
  Words words(const Words& more = {}) const {
    Words out{"record",
              "--probe",
              "file:" + (dir_ / "probe.bin").string(),
              "--poses",
              "file:" + (dir_ / "live/tracker.csv").string(),
              "--calibration",
              dir_ / "calibration.json",
              "--set",
              "recorder.sync_s=0.1",
              "-o",
              dir_ / "work/rec"};
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }
  std::string text_of(const std::string& name) const {
    std::ifstream file(dir_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string rows() const { return text_of("work/rec/probe.csv"); }
  // Of the take, from its first on; a write that failed may have left a part of the next.
  std::string whole_lines() const {
    const std::string kept = rows();
    return kept.substr(0, kept.rfind('\n') + 1);
  }
  bool is_finished() const {
    return text_of("work/rec/recording.json").find("\"state\":\"finished\"") != std::string::npos ||
           text_of("work/rec/recording.json").find("\"state\": \"finished\"") != std::string::npos;
  }

  testkit::TempDir dir_;
};

// A take that the disk ends keeps what came before, and says that it was ended.
TEST_F(RecordFaults, ATakeKeepsWhatCameBefore) {
  Shimmed program(dir_.path());
  const Outcome reference = program.run_with(words(), {});
  ASSERT_TRUE(reference.code == 0 || reference.code == 3) << reference.err;
  const std::string whole_text = rows();
  ASSERT_GT(whole_text.size(), 10'000u);
  std::size_t most_kept = 0;
  const long calls = program.calls().io, stride = number_from("FAULT_STRIDE", 3);
  ASSERT_GT(calls, 5);
  for (long at = 1; at <= calls; at += stride) {
    begin();
    const Outcome outcome = program.run_with(words(), {{"FAULT_AT", std::to_string(at)}});
    const std::string where = "call " + std::to_string(at) + " of " + std::to_string(calls) + ": " + outcome.err;
    EXPECT_LT(outcome.code, 128) << where;
    // The number of calls differs from run to run by the disk's pace: behind the last nothing fails.
    if (program.calls().io < at) continue;
    EXPECT_NE(outcome.code, 0) << where;
    EXPECT_FALSE(outcome.err.empty()) << where;
    if (!fs::exists(dir_ / "work/rec/probe.csv")) continue;
    const std::string lines = whole_lines();
    EXPECT_TRUE(whole_text.starts_with(lines)) << where;
    most_kept = std::max(most_kept, lines.size());
  }
  EXPECT_GT(most_kept, whole_text.size() / 2) << "the last faults come behind nearly all";
  std::printf("record: %ld faults of disk calls\n", (calls + stride - 1) / stride);
}

TEST_F(RecordFaults, ATakeWithoutMemoryKeepsWhatCameBefore) {
  Shimmed program(dir_.path());
  const Outcome reference = program.run_with(words(), {});
  ASSERT_TRUE(reference.code == 0 || reference.code == 3) << reference.err;
  const std::string whole_text = rows();
  const long calls = program.calls().memory, wanted = number_from("FAULT_MEMORY", 12);
  program.run_with({"record"}, {});
  const long started = program.calls().memory;
  ASSERT_LT(started, calls);
  long told = 0, aborted = 0;
  for (long k = 0; k < wanted; ++k) {
    begin();
    const long at = started + (calls - started) * k / wanted;
    const Outcome outcome = program.run_with(words(), {{"FAULT_MALLOC", std::to_string(at)}});
    const std::string where = "allocation " + std::to_string(at) + " of " + std::to_string(calls) + ": " + outcome.err;
    EXPECT_TRUE(whole_text.starts_with(whole_lines())) << where;
    if (outcome.code == 128 + SIGABRT) {
      ++aborted;
      std::printf("aborted: %s\n", where.c_str());
      continue;
    }
    EXPECT_LT(outcome.code, 128) << where;
    if (outcome.code == reference.code) {
      EXPECT_TRUE(is_finished()) << where;
      continue;
    }
    EXPECT_FALSE(outcome.err.empty()) << where;
    ++told;
  }
  EXPECT_LE(10 * aborted, wanted + 10) << "more than the libraries' few";
  std::printf("record: %ld faults of memory, %ld told, %ld aborted in a library\n", wanted, told, aborted);
}

// A capture that the disk refuses ends the take, as the capture's fault and not the probe's; the recording is final.
TEST_F(RecordFaults, ACaptureThatCannotBeWrittenEndsTheTake) {
  Shimmed program(dir_.path());
  const fs::path capture = fs::canonical(dir_ / "work") / "again.bin";
  const Words all = words({"--capture", capture});
  const std::map<std::string, std::string> counted{{"FAULT_ROOT", capture.string()}};
  const Outcome reference = program.run_with(all, counted);
  ASSERT_TRUE(reference.code == 0 || reference.code == 3) << reference.err;
  const std::string whole_text = rows();
  const long calls = program.calls().io;
  ASSERT_GT(calls, 20);
  // The first arrival, one of its lines, and the two syncs at the end.
  for (const long at : {4L, 9L, calls - 1, calls}) {
    begin();
    std::map<std::string, std::string> settings = counted;
    settings["FAULT_AT"] = std::to_string(at);
    const Outcome outcome = program.run_with(all, settings);
    const std::string where = "call " + std::to_string(at) + " of " + std::to_string(calls) + ": " + outcome.err;
    EXPECT_EQ(outcome.code, 1) << where;
    EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr(capture.string()), HasSubstr("Input/output error"))) << where;
    EXPECT_TRUE(whole_text.starts_with(rows())) << where;
    EXPECT_TRUE(is_finished()) << where;
  }
  EXPECT_EQ(rows(), whole_text) << "a sync at the end takes no row";
}

// A camera that is a pipe: 50 black images a second.
class LiveImages {
 public:
  explicit LiveImages(const fs::path& fifo) {
    EXPECT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    file_ = ::open(fifo.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    thread_ = std::thread([this] { play(); });
  }
  ~LiveImages() {
    stop_ = true;
    thread_.join();
    ::close(file_);
  }
  LiveImages(const LiveImages&) = delete;
  LiveImages& operator=(const LiveImages&) = delete;

 private:
  void play() const {
    send("YUV4MPEG2 W64 H48 F50:1 Cmono\n");
    while (!stop_) {
      send("FRAME\n" + std::string(64 * 48, '\0'));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  void send(std::string_view bytes) const {
    while (!bytes.empty() && !stop_) {
      const ssize_t count = ::write(file_, bytes.data(), bytes.size());
      if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
      if (count <= 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  int file_ = -1;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// So does an image that cannot be kept.
TEST_F(RecordFaults, AnImageThatCannotBeWrittenEndsTheTake) {
  std::string calibration = text_of("calibration.json");
  const std::string camera =
      R"("camera":{"width":64,"height":48,"fx":60,"fy":60,"cx":32,"cy":24,"distortion":[0,0,0,0,0]},)";
  calibration.insert(calibration.find("\"accelerometer\""), camera);
  write_text(dir_ / "calibration.json", calibration);
  write_text(dir_ / "markers.json",
             R"({"markers":[{"id":0,"family":"tag36h11","size_m":0.02,"T_marker_tag":[0,0,0,1,0,0,0]}]})");
  Shimmed program(dir_.path());
  const fs::path frames = fs::canonical(dir_ / "work") / "rec/frames";
  const LiveProbe probe;
  int fifos = 0;
  for (const bool full_disk : {false, true}) {
    for (const long at : {1L, 2L, 3L, 9L}) {
      begin();
      const fs::path fifo = dir_ / ("camera" + std::to_string(fifos++));
      const LiveImages images(fifo);
      std::map<std::string, std::string> settings{{"FAULT_ROOT", frames.string()}, {"FAULT_AT", std::to_string(at)}};
      if (full_disk) settings["FAULT_FROM"] = "1";
      const Outcome outcome =
          program.run_with({"record", "--probe", "serial:" + probe.port(), "--camera", "y4m:" + fifo.string(),
                            "--calibration", dir_ / "calibration.json", "--markers", dir_ / "markers.json", "--frames",
                            "--duration", "20s", "-o", dir_ / "work/rec"},
                           settings);
      const std::string where = "call " + std::to_string(at) + ": " + outcome.err;
      EXPECT_EQ(outcome.code, 1) << where;
      EXPECT_THAT(outcome.err, HasSubstr(frames.string())) << where;
      EXPECT_THAT(outcome.err, HasSubstr(full_disk ? "No space left on device" : "Input/output error")) << where;
      EXPECT_TRUE(is_finished()) << where;
      EXPECT_GT(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 0);
      if (!fs::exists(frames)) continue;
      for (const auto& image : fs::directory_iterator(frames)) EXPECT_EQ(image.path().extension(), ".png") << where;
    }
  }
}

}  // namespace
}  // namespace asperity::cli
