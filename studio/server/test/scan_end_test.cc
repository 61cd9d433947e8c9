// A recording that is open when the studio ends: it is finished, or what is lost is stated.
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "asperity/recording/read_recording.h"
#include "scan_bench.h"

namespace asperity::studio {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ScanEnd : public testing::Test {
 protected:
  void SetUp() override {
    bench_.shared.report_loss = [this](const std::string& sentence) { losses_.push_back(sentence); };
    bench_.set("bench.surface", "sine");
    bench_.set("bench.background", "false");
    bench_.set("bench.drop_after_s", "3600");
  }
  void begin_segment() {
    bench_.ask("scan.open");
    bench_.ask("scan.start");
    // Rows and poses are there, however slow the machine is: a recording without any cannot be read.
    ASSERT_TRUE(
        bench_.wait([this] { return bench_.storing() && bench_.recorder().at("recorded_s").get<double>() > 0.2; }));
  }
  // As the studio ends. What is lost.
  std::vector<std::string> end() {
    bench_.page->stop();
    for (const std::string& lost : bench_.jobs->close()) losses_.push_back(lost);
    bench_.inbox.close();
    return losses_;
  }
  // As a disk that fails would: nothing more can be written to it.
  void lose_folder() const { std::filesystem::remove_all(bench_.folder / "scan"); }
  static auto is_incomplete() {
    return ElementsAre(AllOf(HasSubstr("the recording scan is incomplete: "), HasSubstr("recording.json")));
  }

  std::vector<std::string> losses_;
  ScanBench bench_;
};

TEST_F(ScanEnd, AnOpenRecordingIsFinished) {
  begin_segment();
  EXPECT_THAT(end(), IsEmpty());
  EXPECT_EQ(read_recording(bench_.folder / "scan").info.segments.size(), 1U);
}

TEST_F(ScanEnd, AnOpenRecordingThatCannotBeFinishedIsStated) {
  begin_segment();
  lose_folder();
  EXPECT_THAT(end(), is_incomplete());
}

// Its closing was asked for, and waits.
TEST_F(ScanEnd, ARecordingThatWaitsToBeFinishedIsFinished) {
  begin_segment();
  const auto until_cancelled = [](const Observer& observer) {
    for (;; std::this_thread::sleep_for(std::chrono::milliseconds(1))) observer.update("", 0.5);
  };
  bench_.jobs->start_in("scan", "", "", until_cancelled, nullptr);
  bench_.begin("scan.close");
  EXPECT_THAT(end(), IsEmpty());
  EXPECT_EQ(read_recording(bench_.folder / "scan").info.segments.size(), 1U);
}

// The page has not yet got it: dropping it reports its loss.
TEST_F(ScanEnd, ARecordingThatWasJustOpenedAndCannotBeFinishedIsStated) {
  bench_.begin("scan.open");
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (bench_.hub.frames("scan.state").empty() && std::chrono::steady_clock::now() < until) std::this_thread::yield();
  lose_folder();
  EXPECT_THAT(end(), is_incomplete());
}

}  // namespace
}  // namespace asperity::studio
