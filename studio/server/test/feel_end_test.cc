// What a run leaves when the studio ends: its log and the record before a fault are stored, or their loss is stated.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "../../../modules/device/test/fake_drivers.h"
#include "asperity/device/dhd_device.h"
#include "feel_rig.h"

namespace asperity::studio {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

FeelConfig config_with_driver() {
  FeelConfig out = FeelRig::config();
  out.feel.devices.get<DhdConfig>("dhd").library = FAKE_DHD;
  return out;
}

class FeelEnd : public testing::Test {
 protected:
  // As the studio ends. What is lost.
  std::vector<std::string> end() {
    rig_.page->stop();
    for (const std::string& lost : rig_.jobs->close()) losses_.push_back(lost);
    return losses_;
  }
  // What the page starts now waits until the studio's end.
  void keep_jobs_waiting() {
    rig_.jobs->start_in(
        "feel", "", "",
        [](const Observer& observer) {
          for (;; std::this_thread::sleep_for(std::chrono::milliseconds(1))) observer.update("", 0.5);
        },
        nullptr);
  }
  // As a full disk would: no file can be put in the place of a folder.
  void block(const std::string& name) const { std::filesystem::create_directory(rig_.folder / name); }
  bool is_file(const std::string& name) const { return std::filesystem::is_regular_file(rig_.folder / name); }

  std::vector<std::string> losses_;
  FeelRig rig_{true, config_with_driver()};
};

// A run whose log is being written.
class FeelLogEnd : public FeelEnd {
 protected:
  void SetUp() override {
    rig_.shared.report_loss = [this](const std::string& sentence) { losses_.push_back(sentence); };
    rig_.choose_height_maps();
    rig_.own_force();
    ASSERT_EQ(rig_.call("feel.start").error, "");
    ASSERT_EQ(rig_.call("feel.log", {{"on", true}}).result["log"], "feel.csv");
    let_run();
  }
  void let_run() {
    const std::size_t before = rig_.hub.ticks().size();
    ASSERT_TRUE(rig_.wait([&] { return rig_.hub.ticks().size() > before + 200; }));
  }
  void end_log_while_jobs_wait() {
    keep_jobs_waiting();
    rig_.begin("feel.log", {{"on", false}});
    let_run();
    ASSERT_FALSE(is_file("feel.csv"));
  }
  auto is_lost() const {
    return ElementsAre(AllOf(HasSubstr("the log feel.csv is lost: "), HasSubstr((rig_.folder / "feel.csv").string()),
                             HasSubstr("cannot be written")));
  }
};

TEST_F(FeelLogEnd, ARunningLogIsWhole) {
  EXPECT_THAT(end(), IsEmpty());
  EXPECT_TRUE(is_file("feel.csv"));
}

TEST_F(FeelLogEnd, ARunningLogThatIsLostIsStatedOnce) {
  block("feel.csv");
  EXPECT_THAT(end(), is_lost());
  EXPECT_THAT(end(), is_lost());
}

TEST_F(FeelLogEnd, ALogThatWaitsForItsJobIsWhole) {
  end_log_while_jobs_wait();
  EXPECT_THAT(end(), IsEmpty());
  EXPECT_TRUE(is_file("feel.csv"));
}

TEST_F(FeelLogEnd, ALogThatWaitsForItsJobAndIsLostIsStated) {
  block("feel.csv");
  end_log_while_jobs_wait();
  EXPECT_THAT(end(), is_lost());
}

// The run has ended too: no run is there any more when the studio ends.
TEST_F(FeelLogEnd, ALogOfARunThatHasEndedIsWhole) {
  keep_jobs_waiting();
  rig_.begin("feel.stop");
  ASSERT_TRUE(rig_.wait([this] { return rig_.status()["state"] == "idle"; }));
  ASSERT_FALSE(is_file("feel.csv"));
  EXPECT_THAT(end(), IsEmpty());
  EXPECT_TRUE(is_file("feel.csv"));
}

class FlightRecordEnd : public FeelEnd {
 protected:
  static constexpr const char* kRecord = "asperity-feel.flight.csv";

  void SetUp() override {
    rig_.choose_height_maps();
    rig_.own_force();
    rig_.document.edit("/feel/device", "dhd", "device");
    ASSERT_EQ(rig_.call("feel.start").error, "");
    keep_jobs_waiting();
    driver_.set("unplugged", 1);
    ASSERT_TRUE(rig_.wait([this] { return rig_.status()["state"] == "idle"; }));
    ASSERT_EQ(rig_.status()["last_run"]["end"], "fault");
    ASSERT_FALSE(is_file(kRecord));
  }

  testing_devices::FakeDriver driver_{FAKE_DHD, "fake_dhd_"};
};

TEST_F(FlightRecordEnd, ARecordThatWaitsForItsJobIsWritten) {
  EXPECT_THAT(end(), IsEmpty());
  EXPECT_TRUE(is_file(kRecord));
}

TEST_F(FlightRecordEnd, ARecordThatIsLostIsStated) {
  block(kRecord);
  EXPECT_THAT(end(), ElementsAre(AllOf(HasSubstr("the record of the time before the fault is lost: "),
                                       HasSubstr(kRecord), HasSubstr("is not a regular file"))));
}

}  // namespace
}  // namespace asperity::studio
