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
#include "asperity/device/rumble_bands.h"
#include "serve_device.h"
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

std::string message_of(const RumbleSinkConfig& config) {
  try {
    open_rumble_sink(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(RumbleBands, AreTheAmplitudesOfTones) {
  // Gains of analogue second-order Butterworth filters; the bilinear transform bends the frequencies by pi f / rate.
  const auto bent = [](double f_Hz) { return std::tan(std::numbers::pi * f_Hz / 1000.0); };
  const auto low_pass = [&](double f_Hz, double cut_Hz) {
    return 1.0 / std::sqrt(1.0 + std::pow(bent(f_Hz) / bent(cut_Hz), 4));
  };
  const auto high_pass = [&](double f_Hz, double cut_Hz) {
    return 1.0 / std::sqrt(1.0 + std::pow(bent(cut_Hz) / bent(f_Hz), 4));
  };
  for (const double f_Hz : {50.0, 100.0, 250.0}) {
    RumbleBands bands(20.0, 100.0, 1000.0);
    const auto force = tone(0.4, f_Hz);
    for (int i = 0; i < 1000; ++i) bands.add(force(i * 1e-3));
    bands.take();  // the step at the start
    for (int i = 0; i < 1000; ++i) bands.add(force(i * 1e-3));
    const RumbleBands::Amplitudes amplitudes = bands.take();
    EXPECT_NEAR(amplitudes.slow_N, 0.4 * high_pass(f_Hz, 20.0) * low_pass(f_Hz, 100.0), 1e-6) << f_Hz;
    EXPECT_NEAR(amplitudes.fast_N, 0.4 * high_pass(f_Hz, 20.0) * high_pass(f_Hz, 100.0), 1e-6) << f_Hz;
    EXPECT_EQ(bands.take().slow_N, 0.0);
  }
  RumbleBands settled(20.0, 100.0, 1000.0);
  settled.start_at(3.0);
  for (int i = 0; i < 100; ++i) settled.add(3.0);
  EXPECT_LT(settled.take().fast_N, 1e-12);
}

TEST(RumbleSink, DrivesItsMotors) {
  const VirtualGamepad pad("Test Pad");
  const auto sink = open_rumble_sink({});
  EXPECT_EQ(sink->info().name, "gamepad");
  EXPECT_EQ(sink->info().model, "Test Pad");
  // However late the ticks are: 50 and 250 Hz at 1 kHz, which is what the sink is told.
  const auto heavier = [](const VirtualGamepad::Command& command) { return command.low > 2.0 * command.high; };
  const auto lighter = [](const VirtualGamepad::Command& command) { return command.high > 2.0 * command.low; };
  play(*sink, 300, tone(0.4, 50.0));
  const auto slow = pad.commands();
  EXPECT_TRUE(std::any_of(slow.begin(), slow.end(), heavier));
  play(*sink, 300, tone(0.4, 250.0));
  const auto all = pad.commands();
  EXPECT_TRUE(std::any_of(all.begin() + static_cast<std::ptrdiff_t>(slow.size()), all.end(), lighter));
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
  const auto strongest = [&](std::size_t since) {
    double most = 0.0;
    const auto commands = pad.commands();
    for (std::size_t i = since; i < commands.size(); ++i) most = std::max(most, commands[i].high);
    return most;
  };
  play(*sink, 100, tone(0.5, 150.0));
  EXPECT_GT(strongest(0), 0.1);
  EXPECT_TRUE(comes_true([&] { return pad.now().high == 0.0 && pad.now().low == 0.0; }));
  const std::size_t before = pad.commands().size();
  play(*sink, 100, tone(0.5, 150.0));
  EXPECT_GT(strongest(before), 0.1);
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
