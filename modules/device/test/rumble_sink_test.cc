#include "asperity/device/open_rumble_sink.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "virtual_gamepad.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

void play(VibrationSink& sink, int ticks, const std::function<double(double)>& force_N) {
  const auto begin = Clock::now();
  for (int i = 0; i < ticks; ++i) {
    sink.push(force_N(i * 1e-3));
    std::this_thread::sleep_until(begin + std::chrono::milliseconds(i + 1));
  }
}

std::function<double(double)> tone(double amplitude_N, double frequency_Hz) {
  return [=](double t) { return 1.0 + amplitude_N * std::sin(2.0 * std::numbers::pi * frequency_Hz * t); };
}

// The mean of the last updates: their windows do not end with a period.
VirtualGamepad::Command mean_of_last(const VirtualGamepad& pad, std::size_t count) {
  const auto commands = pad.commands();
  VirtualGamepad::Command mean;
  count = std::min(count, commands.size());
  for (std::size_t i = commands.size() - count; i < commands.size(); ++i) {
    mean.low += commands[i].low / static_cast<double>(count);
    mean.high += commands[i].high / static_cast<double>(count);
  }
  return mean;
}

std::string message_of(const RumbleSinkConfig& config) {
  try {
    open_rumble_sink(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(RumbleSink, TheBandsDriveTheirMotors) {
  const VirtualGamepad pad("Test Pad");
  RumbleSinkConfig config;
  config.update_rate_Hz = 50.0;  // whole periods of both tones in an update
  const auto sink = open_rumble_sink(config);
  EXPECT_EQ(sink->info().name, "gamepad");
  EXPECT_EQ(sink->info().model, "Test Pad");
  play(*sink, 300, tone(0.4, 50.0));
  VirtualGamepad::Command now = mean_of_last(pad, 5);
  // Second-order Butterworth bands: at half the split -0.3 dB below and -12.3 dB above, at 2.5 times the high-pass
  // -0.1.
  constexpr double kTol = 0.03;
  EXPECT_NEAR(now.low, 0.5 * 0.4 * 0.99 * 0.97, kTol);
  EXPECT_NEAR(now.high, 0.5 * 0.4 * 0.24, kTol);
  play(*sink, 300, tone(0.4, 250.0));
  now = mean_of_last(pad, 5);
  EXPECT_NEAR(now.low, 0.5 * 0.4 * 0.1, kTol);
  EXPECT_NEAR(now.high, 0.5 * 0.4 * 0.99, kTol);
}

TEST(RumbleSink, UpdatesAtMostAtItsRateAndNeverAboveTheCeiling) {
  const VirtualGamepad pad("Test Pad");
  RumbleSinkConfig config;
  config.volume = 1.0;
  config.ceiling = 0.6;
  const auto sink = open_rumble_sink(config);
  const auto begin = Clock::now();
  int tick = 0;
  play(*sink, 500, [&](double) { return ++tick % 13 == 0 ? std::nan("") : (tick % 4 < 2 ? 1e200 : -1e200); });
  const auto commands = pad.commands();
  const double lasted_s = std::chrono::duration<double>(Clock::now() - begin).count();
  EXPECT_LE(static_cast<double>(commands.size()), 100.0 * lasted_s + 2.0);
  double most = 0.0;
  for (const auto& command : commands) {
    EXPECT_LE(command.low, 0.6);
    EXPECT_LE(command.high, 0.6);
    most = std::max({most, command.low, command.high});
  }
  EXPECT_GT(most, 0.5);
}

TEST(RumbleSink, StopsWithoutForcesAndAtClose) {
  const VirtualGamepad pad("Test Pad");
  const auto sink = open_rumble_sink({});
  play(*sink, 100, tone(0.5, 150.0));
  EXPECT_GT(pad.now().high, 0.1);
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  EXPECT_EQ(pad.now().high, 0.0);
  EXPECT_EQ(pad.now().low, 0.0);
  play(*sink, 100, tone(0.5, 150.0));
  EXPECT_GT(pad.now().high, 0.1);
  sink->close();
  EXPECT_EQ(pad.now().high, 0.0);
  EXPECT_TRUE(sink->working());
}

TEST(RumbleSink, UnplugIsNoticedAndSurvived) {
  VirtualGamepad pad("Test Pad");
  const auto sink = open_rumble_sink({});
  play(*sink, 50, tone(0.5, 150.0));
  pad.unplug();
  for (int i = 0; i < 1000 && sink->working(); ++i) play(*sink, 1, tone(0.5, 150.0));
  EXPECT_FALSE(sink->working());
  EXPECT_EQ(sink->fault(), "gamepad: Test Pad is gone");
  play(*sink, 50, tone(0.5, 150.0));
}

TEST(RumbleSink, RefusalsAreInWords) {
  EXPECT_THAT(message_of({}), HasSubstr("none that rumbles (found: none at all)"));
  const VirtualGamepad still("Still Pad", false);
  EXPECT_THAT(message_of({}), HasSubstr("found: Still Pad"));
  const VirtualGamepad pad("Test Pad");
  RumbleSinkConfig config;
  config.device = "Other";
  EXPECT_THAT(message_of(config), HasSubstr("none named 'Other' that rumbles"));
  config.device = "Test";
  EXPECT_EQ(message_of(config), "no error");
  config.servo_rate_Hz = 100.0;
  EXPECT_THAT(message_of(config), HasSubstr("split_Hz 100 is not below half"));
}

}  // namespace
}  // namespace asperity
