#include "feel/tick_stream.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "feel_rig.h"

namespace asperity::studio {
namespace {

constexpr double kRate_Hz = 1000.0;

// A tip stroked along x at 0.1 m/s under 1 N along z, and 0.1 N of a wave of `wave_Hz` in it.
ServoTick tick_at(int k, double wave_Hz) {
  const double t_s = k / kRate_Hz;
  ServoTick tick;
  tick.t_ns = std::llround(1e9 * t_s);
  tick.p_world_m = {0.1 * t_s, 0.0, 0.0};
  tick.output.proxy_m = tick.p_world_m;
  tick.output.contact.triangle = 0;
  tick.output.contact.normal_world = Eigen::Vector3d::UnitZ();
  tick.output.contact_N = Eigen::Vector3d::UnitZ();
  tick.output.texture_N = 0.1 * std::sin(2.0 * std::numbers::pi * wave_Hz * t_s) * Eigen::Vector3d::UnitZ();
  tick.output.force_N = tick.output.contact_N + tick.output.texture_N;
  tick.out_world_N = tick.output.force_N;
  tick.gain = 1.0;
  return tick;
}

class Sound : public FakeHub {
 public:
  void publish(std::string_view topic, std::string frame, Delivery) override {
    if (topic != kFeelSoundTopic) return;
    for (const float x : ReadBlock(std::move(frame)).array<float>("force_N")) samples.push_back(static_cast<double>(x));
  }
  std::vector<double> samples;
};

class Frames : public FakeHub {
 public:
  void publish(std::string_view topic, std::string frame, Delivery) override {
    frames.push_back(std::string(topic) + ' ' + std::move(frame));
  }
  std::vector<std::string> frames;
};

double rms_N(const std::vector<double>& samples, std::size_t from) {
  double sum = 0.0;
  for (std::size_t k = from; k < samples.size(); ++k) sum += samples[k] * samples[k];
  return std::sqrt(sum / static_cast<double>(samples.size() - from));
}

}  // namespace

TEST(TickStream, TellsEveryTickOnce) {
  FeelHub hub;
  TickStream stream(hub, kRate_Hz, 3);
  for (int k = 0; k < 1000; ++k) stream.add(tick_at(k, 100.0));
  stream.flush();
  ASSERT_EQ(hub.ticks().size(), 1000U);
  for (std::size_t k = 0; k < 1000; ++k) EXPECT_DOUBLE_EQ(hub.ticks()[k].t_s, 1e-3 * static_cast<double>(k));
  EXPECT_EQ(hub.sound(), 1000U);
  // 60 frames a second, by ticks.
  EXPECT_NEAR(static_cast<double>(hub.frames_of("feel.state")), 60.0, 4.0);
  const Json state = hub.state();
  EXPECT_EQ(state["run"], 3U);
  EXPECT_EQ(state["gain"], 1.0);
  EXPECT_EQ(state["touching"], true);
  EXPECT_NEAR(state["way_m"].get<double>(), 0.0999, 1e-9);
  EXPECT_NEAR(state["speed_mps"].get<double>(), 0.1, 1e-6);
}

// Two surfaces under the same point and with the same force on the hand are reported alike.
TEST(TickStream, TellsNothingOfTheSurfaceWhenBlind) {
  const auto told = [](bool other) {
    Frames hub;
    TickStream stream(hub, kRate_Hz, 1, true);
    for (int k = 0; k < 100; ++k) {
      ServoTick tick = tick_at(k, 100.0);
      if (other) {
        tick.output.proxy_m += 1e-3 * k * Eigen::Vector3d::UnitY();
        tick.output.contact.normal_world = Eigen::Vector3d(0.6, 0.0, 0.8);
        tick.output.contact_N *= 0.5;
        tick.output.texture_N *= 2.0;
        tick.output.friction_N = 0.2 * Eigen::Vector3d::UnitX();
        tick.output.texture_height_m = 1e-4;
        tick.output.sticking = true;
        tick.output.starts_inside = true;
      }
      stream.add(tick);
    }
    stream.flush();
    return hub.frames;
  };
  EXPECT_FALSE(told(false).empty());
  EXPECT_EQ(told(false), told(true));
}

TEST(TickStream, MakesNothingForNobody) {
  FeelHub hub;
  hub.subscribed = false;
  TickStream stream(hub, kRate_Hz, 1);
  for (int k = 0; k < 1000; ++k) stream.add(tick_at(k, 100.0));
  stream.flush();
  EXPECT_EQ(hub.frames_of("feel.state") + hub.frames_of("feel.ticks") + hub.frames_of("feel.sound"), 0U);
}

// A second-order Butterworth high-pass at 30 Hz passes 1/√(1 + (w₀/w)⁴), frequencies warped by w = tan(π f/rate).
TEST(TickStream, TheSoundIsTheVibrationWithoutThePush) {
  for (const double wave_Hz : {200.0, 30.0, 3.0}) {
    Sound hub;
    TickStream stream(hub, kRate_Hz, 1);
    for (int k = 0; k < 4000; ++k) stream.add(tick_at(k, wave_Hz));
    stream.flush();
    const auto warped = [](double f_Hz) { return std::tan(std::numbers::pi * f_Hz / kRate_Hz); };
    const double expected_N = 0.1 / std::sqrt(2.0 + 2.0 * std::pow(warped(30.0) / warped(wave_Hz), 4.0));
    EXPECT_NEAR(rms_N(hub.samples, 1000), expected_N, 0.02 * expected_N + 1e-4) << wave_Hz;
  }
}

TEST(TickStream, TheSoundKeepsItsTimeWhereTicksAreLeftOut) {
  FeelHub hub;
  TickStream stream(hub, kRate_Hz, 1);
  for (int k = 0; k < 1000; ++k) {
    if (k % 10 != 7 && k % 10 != 8) stream.add(tick_at(k, 100.0));
  }
  stream.flush();
  EXPECT_EQ(hub.ticks().size(), 800U);
  EXPECT_EQ(hub.sound(), 1000U);
  EXPECT_EQ(hub.state()["skipped"], 200U);
}

}  // namespace asperity::studio
