#include "../src/vibration_voice.h"

#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "../src/soft_limit.h"
#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/device/render_vibration.h"
#include "asperity/testkit/count_allocations.h"

namespace asperity {
namespace {

constexpr double kTau = 2.0 * std::numbers::pi;

std::vector<double> tone(double amplitude_N, double frequency_Hz, double rate_Hz, double duration_s) {
  std::vector<double> force_N(static_cast<std::size_t>(rate_Hz * duration_s));
  for (std::size_t i = 0; i < force_N.size(); ++i) {
    force_N[i] = 1.0 + amplitude_N * std::sin(kTau * frequency_Hz * static_cast<double>(i) / rate_Hz);
  }
  return force_N;
}

// Amplitude of one frequency over a whole number of its periods, by the definition.
double amplitude_at(std::span<const double> x, double frequency_Hz, double rate_Hz) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += x[i] * std::polar(1.0, -kTau * frequency_Hz * static_cast<double>(i) / rate_Hz);
  }
  return 2.0 * std::abs(sum) / static_cast<double>(x.size());
}

double largest_step(std::span<const double> x) {
  double most = 0.0, before = 0.0;
  for (const double now : x) {
    most = std::max(most, std::abs(now - before));
    before = now;
  }
  return std::max(most, std::abs(before));
}

TEST(RenderVibration, AToneArrivesAtItsFrequencyAndAlone) {
  for (const double audio_Hz : {44100.0, 48000.0}) {
    for (const double frequency_Hz : {100.0, 200.0, 350.0}) {
      VibrationConfig config;
      config.audio_rate_Hz = audio_Hz;
      const std::vector<double> sound = render_vibration(tone(0.4, frequency_Hz, 1000.0, 1.3), config);
      ASSERT_EQ(sound.size(), static_cast<std::size_t>(1.3 * audio_Hz));
      // A second of whole periods, after the step at the start has died out.
      const std::span<const double> second(sound.data() + static_cast<std::size_t>(0.25 * audio_Hz),
                                           static_cast<std::size_t>(audio_Hz));
      const double expected =
          0.5 * 0.4 / std::sqrt(1.0 + std::pow(config.high_pass_Hz / frequency_Hz, 4.0));  // Butterworth
      const double measured = amplitude_at(second, frequency_Hz, audio_Hz);
      EXPECT_NEAR(measured, expected, 0.01 * expected) << frequency_Hz;
      double power = 0.0;
      for (const double x : second) power += x * x / static_cast<double>(second.size());
      const double rest = std::sqrt(std::max(0.0, power - 0.5 * measured * measured));
      EXPECT_LT(rest, 1e-3 * measured) << frequency_Hz;  // images and zippers: -60 dB
    }
  }
}

TEST(RenderVibration, IsInTimeWithTheForces) {
  VibrationConfig config;
  std::vector<double> force_N(600, 0.0);
  force_N[300] = 0.5;
  const std::vector<double> sound = render_vibration(force_N, config);
  const auto peak =
      std::max_element(sound.begin(), sound.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  EXPECT_NEAR(static_cast<double>(peak - sound.begin()) / config.audio_rate_Hz, 0.3, 0.2e-3);
}

TEST(RenderVibration, AConstantForceIsSilent) {
  const std::vector<double> sound = render_vibration(std::vector<double>(1000, 2.0), {});
  for (std::size_t i = 9600; i < sound.size(); ++i) EXPECT_LT(std::abs(sound[i]), 1e-6);
}

TEST(RenderVibration, IsTheSameEveryTimeAndRefusesBadInput) {
  const std::vector<double> force_N = tone(0.3, 123.0, 1000.0, 0.2);
  EXPECT_EQ(render_vibration(force_N, {}), render_vibration(force_N, {}));
  EXPECT_TRUE(render_vibration({}, {}).empty());
  EXPECT_THROW(render_vibration(std::vector<double>{std::nan("")}, {}), Error);
  VibrationConfig config;
  config.volume = 1.5;
  EXPECT_THROW(render_vibration(force_N, config), Error);
}

TEST(SoftLimit, IsStraightThenBentAndNeverAboveTheCeiling) {
  EXPECT_EQ(soft_limit(0.2, 0.8), 0.2);
  EXPECT_EQ(soft_limit(-0.4, 0.8), -0.4);
  double before = -1.0;
  for (double x = -3.0; x <= 3.0; x += 1e-3) {
    const double y = soft_limit(x, 0.8);
    EXPECT_LE(std::abs(y), 0.8);
    EXPECT_GE(y, before);
    EXPECT_LE(y - std::max(before, -0.8), 1.001e-3);  // no slope above 1: no jump, no kink upwards
    before = y;
  }
  EXPECT_LE(soft_limit(std::numeric_limits<double>::infinity(), 0.8), 0.8);
  EXPECT_EQ(soft_limit(std::nan(""), 0.8), 0.0);
  EXPECT_LE(static_cast<double>(largest_float_within(0.8)), 0.8);
}

constexpr std::size_t kBlock = 256;

// Renders with forces pushed at `servo_Hz` of the audio clock, a block at a time.
class Player {
 public:
  explicit Player(const VibrationConfig& config)
      : config_(config), voice_(std::make_unique<VibrationVoice>(config, kBlock, VibrationVoice::Clock::kOwn)) {}

  void play(double duration_s, double servo_Hz, const std::function<double(double)>& force_N) {
    const auto blocks = static_cast<int>(duration_s * config_.audio_rate_Hz / kBlock);
    for (int i = 0; i < blocks; ++i) {
      for (due_ += kBlock / config_.audio_rate_Hz * servo_Hz; due_ >= 1.0; due_ -= 1.0) {
        voice_->push(force_N(pushed_s_));
        pushed_s_ += 1.0 / servo_Hz;
      }
      render();
    }
  }
  void starve(double duration_s) {
    for (int i = 0; i < static_cast<int>(duration_s * config_.audio_rate_Hz / kBlock); ++i) render();
  }
  void render() {
    std::array<float, kBlock> block;
    voice_->render(block);
    for (const float x : block) sound.push_back(static_cast<double>(x));
  }
  VibrationVoice& voice() { return *voice_; }

  std::vector<double> sound;

 private:
  VibrationConfig config_;
  std::unique_ptr<VibrationVoice> voice_;
  double due_ = 0.0, pushed_s_ = 0.0;
};

TEST(VibrationVoice, NothingPushedExceedsTheCeiling) {
  VibrationConfig config;
  config.volume = 1.0;
  config.ceiling = 0.7;
  Player player(config);
  Random random(7);
  const double inf = std::numeric_limits<double>::infinity();
  int tick = 0;
  player.play(3.0, 1000.0, [&](double) {
    ++tick;
    if (tick % 50 == 0) return tick % 100 == 0 ? inf : std::nan("");
    return tick < 1500 ? 20.0 * random.normal() : (tick % 7 < 3 ? 1e300 : -1e300);
  });
  double most = 0.0;
  for (const double x : player.sound) {
    ASSERT_LE(std::abs(x), config.ceiling);
    most = std::max(most, std::abs(x));
  }
  EXPECT_GT(most, 0.65);
}

TEST(VibrationVoice, StartsStopsAndGapsDoNotClick) {
  VibrationConfig config;
  Player player(config);
  const auto texture = [](double t) { return 0.6 * std::sin(kTau * 200.0 * t); };
  player.starve(0.05);
  player.play(0.4, 1000.0, texture);
  player.starve(0.2);  // the servo was away
  player.play(0.4, 1000.0, texture);
  player.voice().finish();
  player.starve(0.1);
  EXPECT_TRUE(player.voice().finished());
  EXPECT_GT(*std::max_element(player.sound.begin(), player.sound.end()), 0.28);
  // The steepest of a sine of 0.3 at 200 Hz, and of the fade's 3r² − 2r³.
  const double steepest = 0.3 * (kTau * 200.0 + 1.5 / config.fade_s) / config.audio_rate_Hz;
  EXPECT_LT(largest_step(player.sound), 1.05 * steepest);
  for (std::size_t i = player.sound.size() - 2 * kBlock; i < player.sound.size(); ++i) EXPECT_EQ(player.sound[i], 0.0);
  player.play(0.2, 1000.0, texture);
  EXPECT_EQ(player.sound.back(), 0.0);  // finished for good
}

TEST(VibrationVoice, StaleForcesFadeToSilence) {
  VibrationConfig config;
  Player player(config);
  player.play(0.3, 1000.0, [](double t) { return std::sin(kTau * 150.0 * t); });
  EXPECT_NE(player.sound.back(), 0.0);
  // What waits, what the interpolation holds, and the fade.
  const double silent_after_s = config.buffer_s + kBlock / config.audio_rate_Hz + 0.032 + config.fade_s;
  player.starve(silent_after_s + 2.0 * kBlock / config.audio_rate_Hz);
  EXPECT_EQ(player.sound.back(), 0.0);
  EXPECT_FALSE(player.voice().finished());
}

TEST(VibrationVoice, TwoClocksOnePercentApartStayTogether) {
  for (const double servo_Hz : {990.0, 1000.0, 1010.0}) {
    VibrationConfig config;
    Player player(config);
    player.play(20.0, servo_Hz, [](double t) { return 0.5 * std::sin(kTau * 200.0 * t); });
    int zeros = 0, most_zeros = 0;
    for (std::size_t i = 48000; i < player.sound.size(); ++i) {
      zeros = player.sound[i] == 0.0 ? zeros + 1 : 0;
      most_zeros = std::max(most_zeros, zeros);
    }
    EXPECT_LT(most_zeros, 3) << servo_Hz;  // it never ran dry
    // In the last second the tone has its own frequency, whatever the nominal rate.
    const std::span<const double> last(player.sound.data() + player.sound.size() - 48000, 48000);
    EXPECT_NEAR(amplitude_at(last, 200.0, 48000.0), 0.25, 0.01) << servo_Hz;
    player.voice().finish();
    player.starve(0.1);
    EXPECT_LT(largest_step(player.sound), 1.1 * 0.25 * (kTau * 200.0 + 1.5 / config.fade_s) / 48000.0) << servo_Hz;
  }
}

TEST(VibrationVoice, ADriverThatSleptSkipsWhatIsOld) {
  VibrationConfig config;
  Player player(config);
  for (int i = 0; i < 3000; ++i) player.voice().push(std::sin(kTau * 0.2 * i));
  player.play(1.0, 1000.0, [](double t) { return 0.5 * std::sin(kTau * 100.0 * t); });
  const std::span<const double> late(player.sound.data() + 24000, 19200);
  EXPECT_NEAR(amplitude_at(late, 100.0, 48000.0), 0.25, 0.01);
}

TEST(VibrationVoice, DoesNotAllocate) {
  Player player({});
  player.sound.reserve(100000);
  const std::size_t before = testkit::count_allocations();
  std::array<float, kBlock> block;
  for (int i = 0; i < 10000; ++i) {
    player.voice().push(std::sin(0.1 * i));
    if (i % 5 == 0) player.voice().render(block);
  }
  EXPECT_EQ(testkit::count_allocations(), before);
}

}  // namespace
}  // namespace asperity
