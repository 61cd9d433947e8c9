#include "asperity/device/open_audio_sink.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <numbers>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/testkit/temp_dir.h"
#include "disk_audio.h"
#include "serve_device.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

constexpr double kTau = 2.0 * std::numbers::pi;

AudioSinkConfig on_disk() {
  AudioSinkConfig config;
  config.driver = "disk";
  config.block_samples = DiskAudio::kBlock;
  return config;
}

void play(VibrationSink& sink, int ticks, const std::function<double(double)>& force_N) {
  const auto begin = Clock::now();
  for (int i = 0; i < ticks; ++i) {
    sink.push(force_N(i * 1e-3));
    std::this_thread::sleep_until(begin + std::chrono::milliseconds(i + 1));
  }
}

double largest(const std::vector<double>& sound) {
  double most = 0.0;
  for (const double x : sound) most = std::max(most, std::abs(x));
  return most;
}

std::string message_of(const AudioSinkConfig& config) {
  try {
    open_audio_sink(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(AudioSink, A200HzTextureIsHeardAt200HzWithoutClicks) {
  const testkit::TempDir folder;
  const DiskAudio disk(folder / "sound.raw");
  {
    const auto sink = open_audio_sink(on_disk());
    EXPECT_EQ(sink->info().name, "audio");
    EXPECT_THAT(sink->info().model, HasSubstr("disk"));
    play(*sink, 1000, [](double t) { return 1.0 + 0.5 * std::sin(kTau * 200.0 * t); });
    EXPECT_TRUE(sink->working());
    EXPECT_EQ(sink->fault(), "");
  }
  const std::vector<double> sound = disk.samples();
  ASSERT_GT(sound.size(), 24000U);
  // The median period: the file's clock is the driver's sleep, some percent off, and a busy machine makes gaps.
  std::vector<double> periods;
  double before = 0.0;
  for (std::size_t i = sound.size() / 4; i < sound.size(); ++i) {
    if (sound[i - 1] >= 0.0 || sound[i] < 0.0) continue;
    const double now = static_cast<double>(i) - sound[i] / (sound[i] - sound[i - 1]);
    if (before > 0.0) periods.push_back(now - before);
    before = now;
  }
  ASSERT_GT(periods.size(), 20U);
  std::nth_element(periods.begin(), periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2), periods.end());
  EXPECT_NEAR(48000.0 / periods[periods.size() / 2], 200.0, 20.0);
  EXPECT_LE(largest(sound), 0.8);
  EXPECT_GT(largest(sound), 0.2);
  EXPECT_EQ(sound.front(), 0.0);
  EXPECT_EQ(sound.back(), 0.0);
  // The tap of 1 N at the start, band-limited to half the servo's rate, is the steepest; a click of the driver or of
  // a cut would be as high as the level itself.
  const double steepest = 0.5 * kTau * 500.0 / 48000.0;
  for (std::size_t i = 1; i < sound.size(); ++i) ASSERT_LT(std::abs(sound[i] - sound[i - 1]), steepest) << i;
}

TEST(AudioSink, TheCeilingHoldsWhateverIsPushed) {
  const testkit::TempDir folder;
  const DiskAudio disk(folder / "sound.raw");
  AudioSinkConfig config = on_disk();
  config.vibration.volume = 1.0;
  config.vibration.ceiling = 0.25;
  {
    const auto sink = open_audio_sink(config);
    int tick = 0;
    play(*sink, 300, [&](double) {
      ++tick;
      return tick % 11 == 0 ? std::nan("") : (tick % 5 < 2 ? 1e30 : -1e30);
    });
  }
  const double most = largest(disk.samples());
  EXPECT_LE(most, 0.25);
  EXPECT_GT(most, 0.2);
}

TEST(AudioSink, IsSilentWhenForcesStopAndAfterClose) {
  const testkit::TempDir folder;
  const DiskAudio disk(folder / "sound.raw");
  const auto sink = open_audio_sink(on_disk());
  play(*sink, 200, [](double t) { return 0.5 * std::sin(kTau * 100.0 * t); });
  std::vector<double> sound;
  EXPECT_TRUE(comes_true([&] {
    sound = disk.samples();
    return sound.size() > DiskAudio::kBlock && largest(sound) > 0.0 &&
           std::all_of(sound.end() - DiskAudio::kBlock, sound.end(), [](double x) { return x == 0.0; });
  })) << "it does not become silent";
  sink->close();
  sound = disk.samples();
  sink->push(1.0);
  sink->close();
  EXPECT_EQ(disk.samples().size(), sound.size());
}

TEST(AudioSink, RefusalsAreInWords) {
  AudioSinkConfig config;
  config.driver = "no-such-driver";
  EXPECT_THAT(message_of(config), HasSubstr("no-such-driver"));
  config = {};
  config.block_samples = 7;
  EXPECT_THAT(message_of(config), HasSubstr("audio.block_samples"));
  config = {};
  config.vibration.ceiling = 2.0;
  EXPECT_THAT(message_of(config), HasSubstr("audio.vibration.ceiling"));
  config = {};
  config.driver = "dummy";
  const auto sink = open_audio_sink(config);
  config.driver = "disk";
  EXPECT_THAT(message_of(config), HasSubstr("'disk' was asked for, but 'dummy' is in use"));
}

TEST(AudioSink, LeavesSignalHandlersAlone) {
  const auto mine = [](int) {};
  ASSERT_NE(std::signal(SIGINT, mine), SIG_ERR);
  AudioSinkConfig config;
  config.driver = "dummy";
  open_audio_sink(config);
  EXPECT_EQ(std::signal(SIGINT, SIG_DFL), static_cast<void (*)(int)>(mine));
  // With the default handler SDL would install its own.
  open_audio_sink(config);
  EXPECT_EQ(std::signal(SIGINT, SIG_DFL), SIG_DFL);
}

}  // namespace
}  // namespace asperity
