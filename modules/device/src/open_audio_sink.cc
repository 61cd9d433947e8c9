#include "asperity/device/open_audio_sink.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "check_config.h"
#include "sdl_functions.h"
#include "sdl_subsystem.h"
#include "vibration_voice.h"

namespace asperity {

namespace {

class AudioSink final : public VibrationSink {
 public:
  explicit AudioSink(const AudioSinkConfig& config)
      : sdl_(SDL_INIT_AUDIO, config.driver),
        voice_(config.vibration, static_cast<std::size_t>(config.block_samples), VibrationVoice::Clock::kOwn) {
    SDL_AudioSpec wanted{};
    wanted.freq = static_cast<int>(std::lround(config.vibration.audio_rate_Hz));
    wanted.format = AUDIO_F32SYS;
    wanted.channels = 1;
    wanted.samples = static_cast<Uint16>(config.block_samples);
    wanted.userdata = this;
    wanted.callback = [](void* self, Uint8* bytes, int count) {
      static_cast<AudioSink*>(self)->voice_.render(
          {reinterpret_cast<float*>(bytes), static_cast<std::size_t>(count) / sizeof(float)});
    };
    // No change is allowed: what the hardware cannot do SDL converts.
    device_ = sdl().OpenAudioDevice(config.device.empty() ? nullptr : config.device.c_str(), 0, &wanted, nullptr, 0);
    if (device_ == 0) {
      throw Error("audio: output '" + printable(config.device.empty() ? "default" : config.device) +
                  "' cannot be opened: " + sdl_error());
    }
    info_.name = "audio";
    info_.model = printable(config.device.empty() ? "default output" : config.device) + std::string(" by SDL ") +
                  sdl().GetCurrentAudioDriver();
    sdl().PauseAudioDevice(device_, 0);
  }

  AudioSink(const AudioSink&) = delete;
  AudioSink& operator=(const AudioSink&) = delete;
  ~AudioSink() override { close(); }

  const VibrationInfo& info() const noexcept override { return info_; }
  void push(double force_N) noexcept override {
    if (!closed_) voice_.push(force_N);
  }

  bool working() const noexcept override { return closed_ || sdl().GetAudioDeviceStatus(device_) != SDL_AUDIO_STOPPED; }

  void close() noexcept override {
    if (closed_) return;
    voice_.finish();
    // A driver that has gone asks for no more samples.
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(1500);
    while (!voice_.finished() && working() && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    closed_ = true;
    sdl().CloseAudioDevice(device_);
  }

  std::string fault() const override { return working() ? "" : "audio: " + info_.model + " is gone"; }

 private:
  SdlSubsystem sdl_;
  VibrationVoice voice_;
  SDL_AudioDeviceID device_ = 0;
  VibrationInfo info_;
  bool closed_ = false;
};

}  // namespace

std::unique_ptr<VibrationSink> open_audio_sink(const AudioSinkConfig& config) {
  check_config("audio", config);
  return std::make_unique<AudioSink>(config);
}

}  // namespace asperity
