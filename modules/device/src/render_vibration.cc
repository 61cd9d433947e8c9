#include "asperity/device/render_vibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "asperity/base/error.h"
#include "check_config.h"
#include "vibration_voice.h"

namespace asperity {

std::vector<double> render_vibration(std::span<const double> force_N, const VibrationConfig& config) {
  check_config("vibration", config);
  for (std::size_t i = 0; i < force_N.size(); ++i) {
    if (!std::isfinite(force_N[i])) throw Error("vibration: force " + std::to_string(i) + " is not finite");
  }
  // Of the audio sink's blocks, and short enough that the forces of one fit the ring many times.
  constexpr std::size_t kBlock = 64;
  const auto voice = std::make_unique<VibrationVoice>(config, kBlock, VibrationVoice::Clock::kCommon);
  const auto wanted = static_cast<std::size_t>(
      std::llround(static_cast<double>(force_N.size()) * config.audio_rate_Hz / config.servo_rate_Hz));
  const auto delay = static_cast<std::size_t>(std::llround(voice->delay_samples()));
  const double fade = config.fade_s * config.audio_rate_Hz;
  auto skipped = delay;
  std::vector<double> result;
  result.reserve(wanted);
  std::size_t pushed = 0;
  const auto ahead = static_cast<std::size_t>(kBlock * config.servo_rate_Hz / config.audio_rate_Hz) + 2;
  double rendered = 0.0;
  while (result.size() < wanted) {
    const auto due = static_cast<std::size_t>(rendered * config.servo_rate_Hz / config.audio_rate_Hz) + ahead;
    // Past the end the last force is held for as long as the interpolation looks ahead.
    for (; pushed < std::min(due, force_N.size() + 2 * BandLimitedReader::kAhead); ++pushed) {
      voice->push(force_N[std::min(pushed, force_N.size() - 1)]);
    }
    if (rendered + fade + kBlock >= static_cast<double>(wanted + delay)) voice->finish();
    std::array<float, kBlock> block;
    voice->render(block);
    rendered += kBlock;
    for (const float sample : block) {
      if (skipped > 0) {
        --skipped;
      } else if (result.size() < wanted) {
        result.push_back(static_cast<double>(sample));
      }
    }
  }
  return result;
}

}  // namespace asperity
