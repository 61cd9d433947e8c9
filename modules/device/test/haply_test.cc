#include "asperity/device/open_haply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "asperity/base/error.h"
#include "asperity/testkit/count_allocations.h"
#include "asperity/testkit/lateness_watch.h"
#include "fake_inverse_service.h"
#include "serve_device.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

HaplyConfig config_for(const FakeInverseService& service) {
  HaplyConfig config;
  config.host = "127.0.0.1";
  config.port = service.port();
  return config;
}

// The first reading of status `status` within ten seconds of serving.
DeviceReading await(HapticDevice& device, DeviceStatus status) {
  DeviceReading reading;
  for (int i = 0; i < 10000 && (i == 0 || reading.status != status); ++i) {
    serve(device, 1, [&](const DeviceReading& now) {
      reading = now;
      return Eigen::Vector3d(0.0, 0.5, 0.0);
    });
  }
  return reading;
}

Eigen::Vector3d push_up(const DeviceReading&) { return {0.0, 1.0, 0.0}; }

std::string message_of(const HaplyConfig& config) {
  try {
    open_haply(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Haply, RestsOnAWallAtHalfAMillimetre) {
  for (const char* version : {"3.1.1", "3.5.0"}) {
    FakeInverseConfig fake;
    fake.version = version;
    FakeInverseService service(fake);
    const auto device = open_haply(config_for(service));
    const auto wall = [](const DeviceReading& reading) {
      return Eigen::Vector3d(0.0, std::max(0.0, -2000.0 * reading.p_m.y()), 0.0);
    };
    constexpr double kTol_m = 5e-6;  // 10 mN on 2 N/mm
    double mean_m = 0.0;
    // The hand settles in 0.1 s; more windows only if the machine was away meanwhile.
    for (int window = 0; window < 20 && std::abs(mean_m + 0.5e-3) > kTol_m; ++window) {
      serve(*device, 300, wall);
      double sum_m = 0.0;
      serve(*device, 200, [&](const DeviceReading& reading) {
        sum_m += reading.p_m.y();
        return wall(reading);
      });
      mean_m = sum_m / 200.0;
    }
    EXPECT_NEAR(mean_m, -0.5e-3, kTol_m) << version << " " << device->fault();
    EXPECT_EQ(service.log().unreadable, 0);
    EXPECT_EQ(service.log().profiles, 1);
    EXPECT_TRUE(service.log().profile_first);
  }
}

TEST(Haply, AnswersEachStateByOneMessage) {
  FakeInverseService service;
  auto device = open_haply(config_for(service));
  std::uint64_t last = 0;
  const auto before = Clock::now();
  const auto look = [&](const DeviceReading& reading) {
    EXPECT_GE(reading.sequence, last);
    last = reading.sequence;
    return Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  EXPECT_TRUE(serve_until(*device, look, [&] { return last > 50; }));
  device.reset();
  const double lasted_ms = std::chrono::duration<double, std::milli>(Clock::now() - before).count();
  EXPECT_TRUE(comes_true([&] { return service.log().sessions_closed > 0; }));
  const FakeInverseLog log = service.log();
  EXPECT_EQ(log.messages, log.answers);
  EXPECT_LE(static_cast<double>(last), 4.0 * lasted_ms + 10.0);  // 4 kHz at most, and those before
  EXPECT_EQ(log.sessions_closed, 1);
}

TEST(Haply, MapsAxesBothWays) {
  FakeInverseConfig fake;
  fake.pull_N.setZero();
  fake.start_m = {0.01, 0.02, 0.03};
  FakeInverseService service(fake);
  const auto device = open_haply(config_for(service));
  EXPECT_THAT(device->info().model, HasSubstr("inverse3 049D"));
  EXPECT_TRUE(std::isnan(device->info().max_force_N));
  EXPECT_TRUE(device->info().workspace_min_m.array().isNaN().all());
  EXPECT_EQ(device->read(0).p_m, Eigen::Vector3d(0.01, 0.03, -0.02));
  EXPECT_TRUE(serve_until(
      *device, [](const DeviceReading&) { return Eigen::Vector3d(0.1, 0.2, 0.3); },
      [&] { return service.log().force_N == Eigen::Vector3d(0.1, -0.3, 0.2); }))
      << service.log().force_N.transpose();
}

TEST(Haply, ForgetsAForceThatIsNotRenewed) {
  FakeInverseService service;
  const auto device = open_haply(config_for(service));
  EXPECT_TRUE(serve_until(*device, push_up, [&] { return service.log().force_N.z() == 1.0; }));
  EXPECT_TRUE(comes_true([&] { return service.log().force_N == Eigen::Vector3d::Zero(); }));
  const int messages = service.log().messages;
  EXPECT_TRUE(comes_true([&] { return service.log().messages > messages + 5; })) << "it does not ask for states";
  EXPECT_EQ(device->fault(), "");
}

TEST(Haply, NeverSendsWhatIsNotANumber) {
  FakeInverseService service;
  const auto device = open_haply(config_for(service));
  serve(*device, 30, [](const DeviceReading&) {
    return Eigen::Vector3d(0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  });
  EXPECT_EQ(service.log().force_N, Eigen::Vector3d::Zero());
  EXPECT_EQ(service.log().unreadable, 0);
}

TEST(Haply, CloseLeavesZeroForce) {
  FakeInverseService service;
  const auto device = open_haply(config_for(service));
  EXPECT_TRUE(serve_until(*device, push_up, [&] { return service.applied_N().z() == 1.0; }));
  device->close();
  EXPECT_EQ(service.log().force_N, Eigen::Vector3d::Zero());
  EXPECT_EQ(service.applied_N(), Eigen::Vector3d::Zero());
  device->write({0.0, 1.0, 0.0});
  device->close();
  EXPECT_EQ(service.log().force_N, Eigen::Vector3d::Zero());
}

TEST(Haply, UnplugIsAFaultInWords) {
  FakeInverseService service;
  const auto device = open_haply(config_for(service));
  serve(*device, 20, [](const DeviceReading&) { return Eigen::Vector3d(0.0, 1.0, 0.0); });
  service.unplug();
  EXPECT_EQ(await(*device, DeviceStatus::kFault).status, DeviceStatus::kFault);
  EXPECT_THAT(device->fault(), HasSubstr("device '049D' is gone"));
  device->close();
  EXPECT_EQ(service.log().force_N, Eigen::Vector3d::Zero());  // the service was still there to be told
}

TEST(Haply, ACutConnectionIsAFaultInWords) {
  FakeInverseService service;
  const auto device = open_haply(config_for(service));
  service.drop();
  EXPECT_EQ(await(*device, DeviceStatus::kFault).status, DeviceStatus::kFault);
  EXPECT_THAT(device->fault(), HasSubstr("connection to 127.0.0.1"));
  // A fault stays: nobody reconnects behind the user's back.
  serve(*device, 50, push_up);
  EXPECT_EQ(await(*device, DeviceStatus::kFault).status, DeviceStatus::kFault);
}

TEST(Haply, GarbageIsAFaultInWords) {
  const std::string deep = std::string(1000, '[') + std::string(1000, ']');
  for (const std::string& garbage : {std::string("not json"), deep, std::string(300000, ' '),
                                     std::string(R"({"inverse3":[{"device_id":"049D"}]})")}) {
    FakeInverseService service;
    const auto device = open_haply(config_for(service));
    service.answer_with(garbage);
    EXPECT_EQ(await(*device, DeviceStatus::kFault).status, DeviceStatus::kFault) << garbage.substr(0, 40);
    EXPECT_THAT(device->fault(), HasSubstr("haply:"));
  }
}

TEST(Haply, AStallIsSeenAndEndsWithAZeroForceFirst) {
  FakeInverseService service;
  const auto device = open_haply(config_for(service));
  serve(*device, 20, [](const DeviceReading&) { return Eigen::Vector3d(0.0, 1.0, 0.0); });
  service.stall(true);
  EXPECT_EQ(await(*device, DeviceStatus::kStalled).status, DeviceStatus::kStalled);
  EXPECT_EQ(device->fault(), "");
  service.stall(false);
  EXPECT_EQ(await(*device, DeviceStatus::kReady).status, DeviceStatus::kReady);
  const auto quarter = [](const DeviceReading&) { return Eigen::Vector3d(0.0, 0.25, 0.0); };
  EXPECT_TRUE(serve_until(*device, quarter, [&] { return service.log().force_N.z() == 0.25; }));
  const FakeInverseLog log = service.log();
  EXPECT_LE(log.messages - log.answers, 1);
}

TEST(Haply, ALongStallIsAFault) {
  FakeInverseService service;
  HaplyConfig config = config_for(service);
  config.lost_after_s = 0.1;
  const auto device = open_haply(config);
  service.stall(true);
  EXPECT_EQ(await(*device, DeviceStatus::kFault).status, DeviceStatus::kFault);
  EXPECT_THAT(device->fault(), HasSubstr("no state for 0.1 s"));
}

TEST(Haply, ClosesInTimeWhileTheServiceStalls) {
  FakeInverseService service;
  auto device = open_haply(config_for(service));
  service.stall(true);
  EXPECT_EQ(await(*device, DeviceStatus::kStalled).status, DeviceStatus::kStalled);
  const auto before = Clock::now();
  device.reset();
  EXPECT_LT(Clock::now() - before, std::chrono::seconds(10));  // 0.3 s on an idle machine; the stall has no end
}

TEST(Haply, ReadAndWriteDoNotAllocate) {
  FakeInverseService service;
  const auto device = open_haply(config_for(service));
  serve(*device, 20, [](const DeviceReading&) { return Eigen::Vector3d(0.0, 1.0, 0.0); });
  // This thread is the servo's; the service's and the I/O thread allocate beside it.
  const std::size_t before = testkit::count_own_allocations();
  for (int i = 0; i < 10000; ++i) {
    device->read(i);
    device->write({0.0, 1.0, 0.0});
  }
  EXPECT_EQ(testkit::count_own_allocations(), before);
}

TEST(Haply, ASlowServiceIsServedAtItsRate) {
  FakeInverseService service;
  HaplyConfig config = config_for(service);
  config.lost_after_s = 20.0;  // of a busy machine's late answers
  const auto device = open_haply(config);
  service.answer_after(milliseconds(5));
  const std::uint64_t first = device->read(0).sequence;
  std::uint64_t last = first;
  const auto before = Clock::now();
  const auto look = [&](const DeviceReading& reading) {
    last = reading.sequence;
    EXPECT_NE(reading.status, DeviceStatus::kFault);
    return Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  EXPECT_TRUE(serve_until(*device, look, [&] { return last > first + 30; }));
  const double lasted_ms = std::chrono::duration<double, std::milli>(Clock::now() - before).count();
  EXPECT_LT(static_cast<double>(last - first), lasted_ms / 5.0 + 10.0);
}

TEST(Haply, LateStatesAreNoNewsAndInTheEndAFault) {
  FakeInverseService service;
  HaplyConfig config = config_for(service);
  config.lost_after_s = 0.3;
  const auto device = open_haply(config);
  service.answer_after(milliseconds(30));
  serve(*device, 100, [](const DeviceReading&) { return Eigen::Vector3d::Zero(); });  // one may be under way
  const std::uint64_t last = device->read(0).sequence;
  const DeviceReading reading = await(*device, DeviceStatus::kFault);
  EXPECT_EQ(reading.status, DeviceStatus::kFault);
  EXPECT_EQ(reading.sequence, last);
  EXPECT_THAT(device->fault(), testing::ContainsRegex("its states come [0-9]+ ms late"));
}

// How far a reading is from where the hand is, m. Each state would be older than the one before if the three too many
// were taken for answers; and where each of them had a message sent, messages would pile up at a service that is late,
// until it answers them all at once, which is a fault: infinite then.
double error_with_states_unasked_for_m() {
  FakeInverseService service;
  const auto device = open_haply(config_for(service));
  service.trouble(ServiceTrouble::kFast);
  const std::uint64_t first = device->read(0).sequence;
  std::uint64_t last = first;
  double worst_m = 0.0;
  const auto look = [&](const DeviceReading& reading) {
    last = reading.sequence;
    worst_m = std::max(worst_m, std::abs(reading.p_m.y() - service.position_m().z()));
    return Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  serve(*device, 500, look);
  EXPECT_TRUE(serve_until(*device, look, [&] { return last > first + 50 || !device->fault().empty(); }));
#ifdef __SANITIZE_THREAD__  // a service this slow may answer too late, which is a fault; no reading is wrong before it
  return worst_m;
#else
  return device->fault().empty() ? worst_m : std::numeric_limits<double>::infinity();
#endif
}

TEST(Haply, StatesThatNobodyAskedForAreDropped) {
  constexpr double kTol_m = 1.5e-3;  // 60 ms of the hand's 25 mm/s
  EXPECT_LT(testkit::measure_on_a_free_machine(kTol_m, error_with_states_unasked_for_m), kTol_m);
}

TEST(Haply, RefusalsAreInWords) {
  FakeInverseService service;
  HaplyConfig config = config_for(service);
  config.device_id = "FFFF";
  EXPECT_THAT(message_of(config), HasSubstr("'FFFF' is not in the service's list (049D)"));
  config.device_id.clear();
  config.axes = "XZY";
  EXPECT_THAT(message_of(config), HasSubstr("axes 'XZY'"));
  config = config_for(service);
  config.stall_after_s = 0.0;
  EXPECT_THAT(message_of(config), HasSubstr("haply.stall_after_s"));

  FakeInverseConfig none;
  none.device_id.clear();
  FakeInverseService without(none);
  EXPECT_THAT(message_of(config_for(without)), HasSubstr("the service has no Inverse3"));

  FakeInverseConfig old;
  old.version = "3.0.7";
  FakeInverseService outdated(old);
  EXPECT_THAT(message_of(config_for(outdated)), HasSubstr("3.0.7.0 is too old"));

  int free_port = 0;
  {
    FakeInverseService gone;
    free_port = gone.port();
  }
  config = config_for(service);
  config.port = free_port;
  EXPECT_THAT(message_of(config), HasSubstr("Connection refused; is the Inverse Service running?"));
  config.host = "no-such-host.invalid";
  EXPECT_THAT(message_of(config), HasSubstr("cannot find no-such-host.invalid"));
}

TEST(Haply, AServiceThatNeverAnswersIsGivenUp) {
  FakeInverseService service;
  service.stall(true);
  HaplyConfig config = config_for(service);
  config.open_timeout_s = 0.2;
  EXPECT_THAT(message_of(config), HasSubstr("no state from 127.0.0.1"));
}

}  // namespace
}  // namespace asperity
