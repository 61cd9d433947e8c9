#include "asperity/device/openhaptics_device.h"

#include <signal.h>

#include <chrono>
#include <cstring>
#include <functional>
#include <limits>
#include <thread>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/testkit/count_allocations.h"
#include "conformance.h"
#include "fake_drivers.h"
#include "hd_server.h"
#include "openhaptics_in_time.h"
#include "serve_device.h"

namespace asperity::testing_devices {

namespace {

OpenHapticsConfig fake_config() {
  OpenHapticsConfig config;
  config.library = FAKE_HD;
  // The tests' own loop may be held up on a loaded machine.
  config.stall_after_s = 0.1;
  config.force_timeout_s = 0.1;
  return config;
}

constexpr double kPatient_s = 20.0;

std::unique_ptr<HapticDevice> open_patiently(const OpenHapticsConfig& config) {
  return open_openhaptics_in_time(config, kPatient_s);
}

class OpenHapticsRig final : public DeviceRig {
 public:
  std::unique_ptr<HapticDevice> open() override { return open_patiently(fake_config()); }
  Eigen::Vector3d motor_output() override { return fake_.motor_N(); }
  void unplug() override { fake_.set("unplugged", 1); }
  void stall() override { fake_.set("stalled", 1); }

 private:
  FakeOpenHaptics fake_{FAKE_HD};
};

std::string refusal(const OpenHapticsConfig& config) {
  try {
    open_patiently(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class OpenHaptics : public testing::Test {
 protected:
  FakeOpenHaptics fake_{FAKE_HD};
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(OpenHaptics, DeviceConformance,
                         testing::Values(ConformanceCase{"openhaptics",
                                                         [] { return std::make_unique<OpenHapticsRig>(); }}),
                         case_name);

TEST_F(OpenHaptics, SaysWhatTheDriverSaysInMetres) {
  const auto device = open_patiently(fake_config());
  const DeviceInfo& info = device->info();
  EXPECT_EQ(info.model, "Fake Touch");
  EXPECT_DOUBLE_EQ(info.max_force_N, 3.3);
  EXPECT_DOUBLE_EQ(info.max_continuous_force_N, 0.88);
  EXPECT_DOUBLE_EQ(info.max_stiffness_N_per_m, 500.0);
  EXPECT_TRUE(info.workspace_min_m.isApprox(Eigen::Vector3d(-0.21, -0.11, -0.085)));
  EXPECT_TRUE(info.workspace_max_m.isApprox(Eigen::Vector3d(0.21, 0.205, 0.13)));
  EXPECT_DOUBLE_EQ(info.rate_Hz, 1000.0);
  EXPECT_FALSE(info.simulated);
  fake_.set("stalled", 1);  // the hand stays where it is, once a frame that had begun has ended
  Eigen::Vector3d hand_m = Eigen::Vector3d::Zero();
  EXPECT_TRUE(comes_true([&] {
    fake_.function<void(double*)>("position")(hand_m.data());
    return (device->read(0).p_m - hand_m).norm() < 1e-4;  // moved since by one frame
  })) << hand_m.transpose();
  EXPECT_LT(hand_m.y(), 0.02);
  EXPECT_EQ(device->read(0).buttons, 2u);
}

TEST_F(OpenHaptics, CallsEverythingInItsFrame) {
  {
    const auto device = open_patiently(fake_config());
    EXPECT_TRUE(comes_true([&] { return fake_.function<unsigned long()>("frames")() > 20; }));
  }
  EXPECT_EQ(fake_.function<unsigned()>("calls_out_of_order")(), 0u);
  EXPECT_FALSE(fake_.open());
}

TEST_F(OpenHaptics, AForceThatIsNotRenewedEnds) {
  OpenHapticsConfig config = fake_config();
  config.force_timeout_s = 0.01;
  const auto device = open_patiently(config);
  EXPECT_TRUE(comes_true([&] {
    device->write({0.0, 1.0, 0.0});
    return fake_.motor_N().y() > 0.0;
  }));
  EXPECT_TRUE(comes_true([&] { return fake_.motor_N() == Eigen::Vector3d::Zero(); }));
  EXPECT_EQ(device->fault(), "");
  EXPECT_TRUE(comes_true([&] {
    device->write({0.0, 1.0, 0.0});
    return fake_.motor_N() == Eigen::Vector3d(0.0, 1.0, 0.0);
  })) << "it did not come back";
}

TEST_F(OpenHaptics, TheServoDoesNotAllocate) {
  const auto device = open_patiently(fake_config());
  const std::size_t before = testkit::count_own_allocations();  // the thread that watches the process allocates
  for (std::int64_t i = 0; i < 1000; ++i) device->write(device->read(i * 1'000'000).v_mps);
  EXPECT_EQ(testkit::count_own_allocations(), before);
}

// In this process, where it can be counted.
TEST_F(OpenHaptics, TheCallbackDoesNotAllocate) {
  auto mailbox = std::make_unique<hd::Mailbox>();
  std::strcpy(mailbox->library.data(), FAKE_HD);
  hd::Server server(*mailbox);
  const auto frames = [&] { return mailbox->frames.load(); };
  const std::uint64_t first = frames();
  ASSERT_TRUE(comes_true([&] { return frames() > first + 2; }));  // its first frame asks for its priority
  const std::size_t before = testkit::count_allocations();
  EXPECT_TRUE(comes_true([&] { return frames() > first + 100; }));
  EXPECT_EQ(testkit::count_allocations(), before);
}

TEST_F(OpenHaptics, TheDriverClampsItsForce) {
  const auto device = open_patiently(fake_config());
  EXPECT_TRUE(comes_true([&] {
    device->write({0.0, 0.0, 30.0});
    return fake_.motor_N().z() > 3.29;
  }));
  EXPECT_LE(fake_.motor_N().z(), 3.3 + 1e-12);
}

TEST_F(OpenHaptics, WarmMotorsAreReportedAndItGoesOn) {
  const auto device = open_patiently(fake_config());
  for (const unsigned code : {0x200u, 0x201u, 0x203u}) fake_.function<void(unsigned)>("complain")(code);
  EXPECT_TRUE(comes_true([&] { return !device->fault().empty(); }));
  EXPECT_TRUE(comes_true([&] { return device->fault().find("0x203") != std::string::npos; }));
  EXPECT_THAT(device->fault(), testing::AllOf(testing::HasSubstr("motors are warm"), testing::HasSubstr("0x201")));
  const std::uint64_t before = device->read(0).sequence;
  EXPECT_TRUE(comes_true([&] { return device->read(0).sequence > before; }));
  EXPECT_EQ(device->read(0).status, DeviceStatus::kReady);
}

TEST_F(OpenHaptics, LostCommunicationIsAFaultThatStays) {
  const auto device = open_patiently(fake_config());
  fake_.function<void(unsigned)>("complain")(0x302);
  EXPECT_TRUE(comes_true([&] { return device->read(0).status == DeviceStatus::kFault; }));
  EXPECT_THAT(device->fault(), testing::HasSubstr("connection"));
  device->write({0.0, 1.0, 0.0});
  const auto frames = [&] { return fake_.function<unsigned long()>("frames")(); };
  const unsigned long then = frames();
  EXPECT_TRUE(comes_true([&] { return frames() > then + 20; }));
  EXPECT_EQ(fake_.motor_N(), Eigen::Vector3d::Zero());
  EXPECT_EQ(device->read(1'000'000).status, DeviceStatus::kFault);
}

TEST_F(OpenHaptics, AStallEnds) {
  const auto device = open_patiently(fake_config());
  fake_.set("stalled", 1);
  EXPECT_TRUE(comes_true([&] {  // a frame that had begun is still to come
    device->read(0);
    return device->read(1'000'000'000).status == DeviceStatus::kStalled;
  }));
  fake_.set("stalled", 0);
  EXPECT_TRUE(comes_true([&] { return device->read(1'001'000'000).status == DeviceStatus::kReady; }));
}

TEST_F(OpenHaptics, AnswersThatAreNoNumbersAreNoNews) {
  const auto device = open_patiently(fake_config());
  fake_.set("garbage", 1);
  const auto frames = [&] { return fake_.function<unsigned long()>("frames")(); };
  const unsigned long then = frames();
  EXPECT_TRUE(comes_true([&] { return frames() > then + 2; }));
  const std::uint64_t before = device->read(0).sequence;
  EXPECT_TRUE(comes_true([&] { return frames() > then + 20; }));
  EXPECT_EQ(device->read(0).sequence, before);
}

// The driver's process is ended, and with it the connection; what the device does then is the driver's and its own.
TEST_F(OpenHaptics, ADriverThatDoesNotReturnIsAFault) {
  auto device = open_openhaptics(fake_config());
  const pid_t process = fake_.process();
  fake_.set("hangs", 1);
  EXPECT_TRUE(comes_true([&] { return device->read(0).status == DeviceStatus::kFault; }));
  EXPECT_THAT(device->fault(), testing::HasSubstr("has not returned for 0.1 s"));
  // The fault is stated just before the process ends.
  EXPECT_TRUE(comes_true([&] { return !fake_.open(); }));
  device->close();
  device.reset();
  EXPECT_NE(::kill(process, 0), 0);  // it is waited for
}

TEST_F(OpenHaptics, AStoppedProcessIsEnded) {
  const auto device = open_openhaptics(fake_config());
  ::kill(fake_.process(), SIGSTOP);
  EXPECT_TRUE(comes_true([&] { return device->read(0).status == DeviceStatus::kFault; }));
  EXPECT_THAT(device->fault(), testing::HasSubstr("has not returned for 0.1 s"));
  EXPECT_TRUE(comes_true([&] { return !fake_.open(); }));
}

TEST_F(OpenHaptics, AKilledProcessIsAFault) {
  const auto device = open_patiently(fake_config());
  ::kill(fake_.process(), SIGKILL);
  EXPECT_TRUE(comes_true([&] { return device->read(0).status == DeviceStatus::kFault; }));
  EXPECT_EQ(device->fault(), "the driver's process ended by signal 9");
  device->write({0.0, 1.0, 0.0});
  device->close();
  EXPECT_EQ(device->read(0).status, DeviceStatus::kFault);
}

TEST_F(OpenHaptics, RefusalsNameTheirCause) {
  using testing::HasSubstr;
  OpenHapticsConfig config = fake_config();
  config.library = "/nonexistent/libHD.so";
  EXPECT_THAT(refusal(config), testing::AllOf(HasSubstr("openhaptics"), HasSubstr("/nonexistent/libHD.so")));
  config.library = FAKE_HD_INCOMPLETE;
  EXPECT_THAT(refusal(config), testing::AllOf(HasSubstr(FAKE_HD_INCOMPLETE), HasSubstr("hdScheduleAsynchronous")));
  config = fake_config();
  config.device = "Left";
  EXPECT_THAT(refusal(config), testing::AllOf(HasSubstr("'Left'"), HasSubstr("0x300")));
  config.device.clear();
  fake_.set("unplugged", 1);
  EXPECT_THAT(refusal(config), HasSubstr("connection"));
  EXPECT_FALSE(fake_.open());
  fake_.set("unplugged", 0);
  fake_.set("mute", 1);
  EXPECT_THAT(refusal(config), HasSubstr("does not call back"));
  EXPECT_FALSE(fake_.open());
  fake_.set("mute", 0);
  EXPECT_EQ(refusal(config), "");
  config.force_timeout_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(config), HasSubstr("force_timeout_s"));
}

// The system has no such driver: the message says where it was looked for.
TEST(OpenHapticsDriver, IsLookedForByItsName) {
  OpenHapticsConfig config;
  const std::string message = refusal(config);
  EXPECT_TRUE(message.empty() || message.find("libHD.so") != std::string::npos) << message;
}

}  // namespace asperity::testing_devices
