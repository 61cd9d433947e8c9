#include "asperity/device/dhd_device.h"

#include <cstdlib>
#include <limits>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/testkit/count_allocations.h"
#include "conformance.h"
#include "fake_drivers.h"

namespace asperity::testing_devices {

namespace {

DhdConfig fake_config() {
  DhdConfig config;
  config.library = FAKE_DHD;
  return config;
}

class DhdRig final : public DeviceRig {
 public:
  std::unique_ptr<HapticDevice> open() override { return open_dhd(fake_config()); }
  Eigen::Vector3d motor_output() override { return fake_.motor_N(); }
  bool real_time() const override { return false; }
  void unplug() override { fake_.set("unplugged", 1); }
  void stall() override { fake_.set("stalled", 1); }

 private:
  FakeDriver fake_{FAKE_DHD, "fake_dhd_"};
};

std::string refusal(const DhdConfig& config) {
  try {
    open_dhd(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class Dhd : public testing::Test {
 protected:
  FakeDriver fake_{FAKE_DHD, "fake_dhd_"};
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Dhd, DeviceConformance,
                         testing::Values(ConformanceCase{"dhd", [] { return std::make_unique<DhdRig>(); }}), case_name);

TEST_F(Dhd, TurnsItsAxesIntoOurs) {
  const auto device = open_dhd(fake_config());
  EXPECT_EQ(device->info().model, "Fake omega.3");
  fake_.function<void(double, double, double)>("move")(0.01, 0.02, 0.03);  // right, up, toward the user
  const DeviceReading reading = device->read(0);
  EXPECT_EQ(reading.p_m, Eigen::Vector3d(0.01, 0.02, 0.03));
  EXPECT_EQ(reading.buttons, 5u);
  device->write({0.1, 0.2, 0.3});
  EXPECT_EQ(fake_.motor_N(), Eigen::Vector3d(0.1, 0.2, 0.3));
}

TEST_F(Dhd, SetsTheControllersWatchdog) {
  const auto device = open_dhd(fake_config());
  EXPECT_EQ(fake_.function<int()>("watchdog_steps")(), 240);  // 30 ms in steps of 125 µs
  EXPECT_EQ(fake_.function<int()>("expert")(), 0);
  EXPECT_EQ(device->fault(), "");
}

TEST_F(Dhd, IsNotOpenedWithoutAWatchdogUnlessThatIsStated) {
  fake_.set("no_watchdog", 1);
  try {
    open_dhd(fake_config());
    ADD_FAILURE() << "it was opened";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("dhd.without_watchdog=true"));
  }
  EXPECT_EQ(fake_.motor_N(), Eigen::Vector3d::Zero());
  DhdConfig config = fake_config();
  config.without_watchdog = true;
  const auto device = open_dhd(config);
  EXPECT_EQ(device->read(0).status, DeviceStatus::kReady);
  EXPECT_THAT(device->fault(), testing::HasSubstr("has no watchdog"));
}

TEST_F(Dhd, SaturatedMotorsAreNoError) {
  const auto device = open_dhd(fake_config());
  for (std::int64_t t_ns = 0; t_ns < 50'000'000; t_ns += 1'000'000) {
    EXPECT_EQ(device->read(t_ns).status, DeviceStatus::kReady);
    device->write({0.0, 100.0, 0.0});
  }
  EXPECT_NEAR(fake_.motor_N().y(), 12.0, 1e-12);
  EXPECT_EQ(device->fault(), "");
}

TEST_F(Dhd, ALostPacketIsNoFaultAndManyAreOne) {
  const auto device = open_dhd(fake_config());
  device->read(0);
  fake_.set("failures", 4);
  for (std::int64_t t_ns = 1'000'000; t_ns < 30'000'000; t_ns += 1'000'000) device->read(t_ns);
  EXPECT_EQ(device->read(30'000'000).status, DeviceStatus::kReady);
  fake_.set("failures", 5);
  for (std::int64_t t_ns = 31'000'000; t_ns < 36'000'000; t_ns += 1'000'000) device->read(t_ns);
  EXPECT_EQ(device->read(36'000'000).status, DeviceStatus::kFault);
  EXPECT_THAT(device->fault(), testing::HasSubstr("timeout"));
}

TEST_F(Dhd, OneCallThatWorksDoesNotHideThatAnotherFails) {
  for (const char* const call : {"refuses_force", "refuses_position"}) {
    fake_.function<void()>("reset")();
    const auto device = open_dhd(fake_config());
    device->read(0);
    device->write({0.0, 1.0, 0.0});
    fake_.set(call, 1);
    for (std::int64_t t_ns = 1'000'000; t_ns < 7'000'000; t_ns += 1'000'000) {
      device->read(t_ns);
      device->write({0.0, 1.0, 0.0});
    }
    EXPECT_EQ(device->read(7'000'000).status, DeviceStatus::kFault) << call;
    EXPECT_EQ(fake_.function<int()>("force_enabled")(), 0) << call;
  }
}

TEST_F(Dhd, AlwaysNamesTheDefaultDeviceAndLeavesNothingOn) {
  {
    const auto device = open_dhd(fake_config());
    device->write({1.0, 1.0, 1.0});
    EXPECT_EQ(fake_.function<int()>("force_enabled")(), 1);
  }
  EXPECT_EQ(fake_.function<int()>("wrong_device")(), 0);
  EXPECT_EQ(fake_.function<int()>("force_enabled")(), 0);
  EXPECT_FALSE(fake_.open());
}

TEST_F(Dhd, TicksDoNotAllocate) {
  const auto device = open_dhd(fake_config());
  const std::size_t before = testkit::count_allocations();
  for (std::int64_t t_ns = 0; t_ns < 100'000'000; t_ns += 1'000'000) device->write(device->read(t_ns).v_mps);
  fake_.set("unplugged", 1);
  for (std::int64_t t_ns = 100'000'000; t_ns < 200'000'000; t_ns += 1'000'000) device->write(device->read(t_ns).v_mps);
  EXPECT_EQ(testkit::count_allocations(), before);
}

TEST_F(Dhd, RefusalsNameTheirCause) {
  using testing::HasSubstr;
  DhdConfig config = fake_config();
  config.library = FAKE_DHD_INCOMPLETE;
  EXPECT_THAT(refusal(config), testing::AllOf(HasSubstr(FAKE_DHD_INCOMPLETE), HasSubstr("dhdErrorGetLastStr")));
  config = fake_config();
  fake_.set("absent", 1);
  EXPECT_THAT(refusal(config), HasSubstr("no device found"));
  fake_.set("absent", 0);
  fake_.set("unplugged", 1);
  EXPECT_THAT(refusal(config), HasSubstr("communication error"));
  EXPECT_FALSE(fake_.open());
  config.rate_Hz = 0.0;
  EXPECT_THAT(refusal(config), HasSubstr("rate_Hz"));
}

TEST(DhdDriver, IsLookedForByItsNamesAndInTheSdk) {
  setenv("FDSDK", "/nonexistent/sdk", 1);
  const std::string message = refusal({});
  unsetenv("FDSDK");
  if (message.find("searched") == std::string::npos) return;  // a driver is installed
  for (const char* name : {"libdrd.so.3:", "libdrd.so:", "libdhd.so.3:", "libdhd.so:",
                           "/nonexistent/sdk/lib/release/lin-x86_64-gcc/libdrd.so.3:"}) {
    EXPECT_THAT(message, testing::HasSubstr(name));
  }
}

}  // namespace asperity::testing_devices
