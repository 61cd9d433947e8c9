#include "asperity/device/open_two_diy.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../src/pantograph.h"
#include "asperity/base/error.h"
#include "asperity/testkit/count_allocations.h"
#include "asperity/testkit/lateness_watch.h"
#include "asperity/testkit/temp_dir.h"
#include "conformance.h"
#include "fake_two_diy_board.h"
#include "serve_device.h"

namespace asperity {
namespace {

using testing::HasSubstr;

TwoDiyConfig config_for(const FakeTwoDiyBoard& board) {
  TwoDiyConfig config;
  config.port = board.port();
  return config;
}

std::string message_of(const TwoDiyConfig& config) {
  try {
    open_two_diy(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Pantograph, AgreesWithTheLawOfCosines) {
  for (double x = -0.03; x <= 0.05; x += 0.01) {
    for (double y = 0.04; y <= 0.09; y += 0.01) {
      const Eigen::Vector2d p_m(x, y);
      const auto state = pantograph_state({}, pantograph_angles_rad(p_m));
      ASSERT_TRUE(state);
      EXPECT_LT((state->p_m - p_m).norm(), 1e-15) << p_m.transpose();
      // The Jacobian against differences of the inverse kinematics.
      constexpr double kStep_m = 1e-6;
      Eigen::Matrix2d inverse;
      for (int i = 0; i < 2; ++i) {
        const Eigen::Vector2d step = kStep_m * Eigen::Vector2d::Unit(i);
        inverse.col(i) = (pantograph_angles_rad(p_m + step) - pantograph_angles_rad(p_m - step)) / (2.0 * kStep_m);
      }
      EXPECT_LT((state->jacobian_m * inverse - Eigen::Matrix2d::Identity()).norm(), 1e-7) << p_m.transpose();
    }
  }
}

TEST(Pantograph, HasNoStateWhereTheTipIsNotHeld) {
  EXPECT_FALSE(pantograph_state({}, {std::nan(""), 0.0}));
  EXPECT_FALSE(pantograph_state({0.1, 0.05, 0.02}, {std::numbers::pi, 0.0}));   // elbows 0.22 m apart, arms 0.1
  EXPECT_FALSE(pantograph_state({0.05, 0.06, 0.02}, {std::numbers::pi, 0.0}));  // distal arms in line
  EXPECT_FALSE(pantograph_state({0.05, 0.07, 0.0}, {1.0, 1.0}));                // elbows on each other
}

TEST(TwoDiy, ReadsThePlaceItIsAtAndPushesWhereItIsTold) {
  for (const bool directions : {false, true}) {
    FakeBoardConfig still;
    still.directions = directions;
    still.pull_N.setZero();
    FakeTwoDiyBoard board(still);
    TwoDiyConfig config = config_for(board);
    config.directions = directions;
    const auto device = open_two_diy(config);
    const Eigen::Vector3d p_m = device->read(0).p_m;
    EXPECT_NEAR(p_m.x(), 0.01, 1e-9);
    EXPECT_EQ(p_m.y(), 0.0);
    EXPECT_NEAR(p_m.z(), std::sqrt(0.07 * 0.07 - 0.06 * 0.06), 1e-9);
    // The torques are of the last place that the driver knows; the tip moves on until it answers.
    EXPECT_TRUE(serve_until(
        *device, [](const DeviceReading&) { return Eigen::Vector3d(0.3, 7.0, -0.4); },
        [&] { return (board.force_N() - Eigen::Vector2d(0.3, -0.4)).cwiseAbs().maxCoeff() < 0.02; }))
        << board.force_N().transpose();
  }
}

TEST(TwoDiy, RestsOnAWallWithinACountOfItsEncoders) {
  FakeTwoDiyBoard board;
  TwoDiyConfig config = config_for(board);
  config.plane = TwoDiyPlane::kUpright;
  const auto device = open_two_diy(config);
  const double wall_y_m = device->read(0).p_m.y() - 2e-3;
  const auto wall = [&](const DeviceReading& reading) {
    return Eigen::Vector3d(0.0, 2000.0 * std::max(0.0, wall_y_m - reading.p_m.y()), 0.0);
  };
  // A count is 2π/13824 of a turn at an arm of 0.05 m; the linkage doubles it at most here.
  constexpr double kTol_m = 50e-6;
  double depth_m = 0.0;
  for (int i = 0; i < 20 && std::abs(depth_m - 0.5e-3) > kTol_m; ++i) {
    serve(*device, 200, wall);
    depth_m = wall_y_m + board.p_m().y();
  }
  EXPECT_NEAR(depth_m, 0.5e-3, kTol_m) << device->fault();
}

TEST(TwoDiy, TorquesAreLimitedTogether) {
  FakeBoardConfig still;
  still.pull_N.setZero();
  still.damping_N_s_per_m = 1e5;
  still.mass_kg = 100.0;
  FakeTwoDiyBoard board(still);
  TwoDiyConfig config = config_for(board);
  config.max_torque_N_m = 0.02;
  const auto device = open_two_diy(config);
  EXPECT_TRUE(serve_until(
      *device, [](const DeviceReading&) { return Eigen::Vector3d(100.0, 0.0, 50.0); },
      [&] { return std::abs(board.torque_N_m().cwiseAbs().maxCoeff() - 0.02) < 1e-6; }))
      << board.torque_N_m().transpose();
  const Eigen::Vector2d direction = board.force_N().normalized();
  EXPECT_NEAR(direction.x(), 2.0 / std::sqrt(5.0), 1e-3);
}

TEST(TwoDiy, TheBoardHoldsNoTorqueAfterCloseOrSilence) {
  FakeTwoDiyBoard board;
  const auto device = open_two_diy(config_for(board));
  const auto push = [](const DeviceReading&) { return Eigen::Vector3d(0.0, 0.0, -1.0); };
  const auto pushed = [&] { return board.torque_N_m().norm() > 0.0; };
  EXPECT_TRUE(serve_until(*device, push, pushed));
  EXPECT_TRUE(comes_true([&] { return !pushed(); })) << "the servo is away";
  EXPECT_TRUE(serve_until(*device, push, pushed));
  const int resets = board.resets();
  device->close();
  EXPECT_TRUE(comes_true([&] { return board.resets() != resets; }));
  EXPECT_EQ(board.torque_N_m(), Eigen::Vector2d::Zero());
}

TEST(TwoDiy, AKilledProcessLeavesNoTorque) {
  FakeTwoDiyBoard board;
  const pid_t host = ::fork();
  if (host == 0) {
    const auto device = open_two_diy(config_for(board));
    serve(*device, 30000, [](const DeviceReading&) { return Eigen::Vector3d(0.0, 0.0, -1.0); });
    ::_exit(0);
  }
  EXPECT_TRUE(comes_true([&] { return board.torque_N_m().norm() > 0.0; }));
  ::kill(host, SIGKILL);
  ::waitpid(host, nullptr, 0);
  EXPECT_TRUE(comes_true([&] { return board.torque_N_m() == Eigen::Vector2d::Zero(); }));
}

// ms from SIGSTOP to zero torque.
double stop_a_process_ms() {
  FakeTwoDiyBoard board;
  const pid_t host = ::fork();
  if (host == 0) {
    const auto device = open_two_diy(config_for(board));
    // Until it has a fault.
    for (;;) {
      if (device->read(0).status == DeviceStatus::kFault) break;
      serve(*device, 1, [](const DeviceReading&) { return Eigen::Vector3d(0.0, 0.0, -1.0); });
    }
    const bool told = device->fault().find("was stopped") != std::string::npos;
    ::_exit(told ? 7 : 1);
  }
  EXPECT_TRUE(comes_true([&] { return board.torque_N_m().norm() > 0.0; }));
  ::kill(host, SIGSTOP);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(comes_true([&] { return board.torque_N_m() == Eigen::Vector2d::Zero(); }));
  const std::chrono::duration<double, std::milli> waited = std::chrono::steady_clock::now() - start;
  ::kill(host, SIGCONT);
  int status = 0;
  ::waitpid(host, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 7);
  EXPECT_EQ(board.torque_N_m(), Eigen::Vector2d::Zero());
  return waited.count();
}

TEST(TwoDiy, AStoppedProcessLeavesNoTorqueAndAwakesToAFault) {
  EXPECT_LT(testkit::measure_on_a_free_machine(150.0, stop_a_process_ms), 150.0);
}

// The fault of a board that answers nonsense, or nothing any more.
std::string fault_of_a_board(bool nonsense) {
  FakeTwoDiyBoard board;
  TwoDiyConfig config = config_for(board);
  config.lost_after_s = 0.1;
  const auto device = open_two_diy(config);
  if (nonsense) board.answer_nonsense();
  board.stall(!nonsense);
  DeviceStatus status = DeviceStatus::kReady;
  const auto look = [&](const DeviceReading& reading) {
    status = reading.status;
    return Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  EXPECT_TRUE(serve_until(*device, look, [&] { return status == DeviceStatus::kFault; }));
  return device->fault();
}

TEST(TwoDiy, NonsenseAndLongStallsAreFaultsInWords) {
  EXPECT_THAT(fault_of_a_board(true), HasSubstr("are not valid"));
  // On a busy machine its last answer may have been late, which is told instead.
  std::string fault;
  EXPECT_TRUE(testkit::holds_on_a_free_machine([&] {
    fault = fault_of_a_board(false);
    return fault.find("no answer for 0.1 s") != std::string::npos;
  })) << fault;
}

TEST(TwoDiy, LateAnswersAreNoNewsAndInTheEndAFault) {
  for (const BoardTrouble kind : {BoardTrouble::kSlow, BoardTrouble::kLate}) {
    FakeTwoDiyBoard board;
    TwoDiyConfig config = config_for(board);
    config.lost_after_s = 0.3;
    const auto device = open_two_diy(config);
    serve(*device, 20, [](const DeviceReading&) { return Eigen::Vector3d::Zero(); });
    board.trouble(kind);
    DeviceReading reading;
    const auto push = [&](const DeviceReading& now) {
      reading = now;
      return Eigen::Vector3d(0.0, 0.0, -1.0);
    };
    // What was under way when the trouble began may still come in time.
    EXPECT_TRUE(serve_until(*device, push, [&] { return reading.status != DeviceStatus::kReady; }));
    const std::uint64_t last = reading.sequence;
    EXPECT_TRUE(serve_until(*device, push, [&] { return reading.status == DeviceStatus::kFault; }));
    EXPECT_EQ(reading.sequence, last);
    EXPECT_THAT(device->fault(), testing::ContainsRegex("its answers come [0-9]+ ms late"));
    EXPECT_TRUE(comes_true([&] { return board.torque_N_m() == Eigen::Vector2d::Zero(); }));
  }
}

TEST(TwoDiy, RefusalsAreInWords) {
  EXPECT_THAT(message_of({}), HasSubstr("2diy.port"));
  TwoDiyConfig config;
  config.port = "/nowhere/ttyACM0";
  EXPECT_THAT(message_of(config), HasSubstr("/nowhere/ttyACM0: the port does not exist; is the board plugged in?"));
  config.port = "/dev/null";
  EXPECT_THAT(message_of(config), HasSubstr("is not a serial port"));
  FakeTwoDiyBoard board;
  board.stall(true);
  EXPECT_THAT(message_of(config_for(board)), HasSubstr("no answer within a second"));
  config = config_for(board);
  config.distal_m = 0.0;
  EXPECT_THAT(message_of(config), HasSubstr("2diy.distal_m"));
}

}  // namespace

namespace testing_devices {
namespace {

class TwoDiyRig final : public DeviceRig {
 public:
  std::unique_ptr<HapticDevice> open() override {
    TwoDiyConfig config;
    config.port = board_.port();
    config.plane = TwoDiyPlane::kUpright;
    config.encoder_counts = 13824.0 * 1000.0;  // a count of the real ones is 23 µm, more than the suite allows
    return open_two_diy(config);
  }
  Eigen::Vector3d motor_output() override {
    const Eigen::Vector2d force_N = board_.force_N();
    return {force_N.x(), -force_N.y(), 0.0};
  }
  void unplug() override { board_.unplug(); }
  void stall() override { board_.stall(true); }

 private:
  FakeTwoDiyBoard board_;
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(TwoDiy, DeviceConformance,
                         testing::Values(ConformanceCase{"two_diy", [] { return std::make_unique<TwoDiyRig>(); }}),
                         case_name);

}  // namespace testing_devices
}  // namespace asperity
