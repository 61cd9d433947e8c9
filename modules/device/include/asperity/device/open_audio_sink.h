#pragma once

#include <memory>
#include <string>

#include "asperity/device/vibration_config.h"
#include "asperity/device/vibration_sink.h"

namespace asperity {

struct AudioSinkConfig {
  std::string driver;       // SDL's: "pipewire", "alsa", "disk", …; empty: its choice
  std::string device;       // as SDL calls it; empty: the default output
  int block_samples = 256;  // that the driver asks for at once
  VibrationConfig vibration;
  template <class V>
  void visit(V& v) {
    v.field("driver", driver, "SDL audio driver; empty: SDL's choice");
    v.field("device", device, "output by its SDL name; empty: the default");
    v.field("block_samples", block_samples, "samples the driver asks for at once", {32, 8192});
    v.group("vibration", vibration);
  }
};

// A sound card by SDL 2, one channel of float samples. push() puts the force in a ring; the driver's thread makes the
// samples from it, about 16 servo ticks, `buffer_s` and a block later. Without forces for longer than the ring holds
// it fades out; it fades in again when they come. The amplitude is limited for any input.
// The process's handlers of SIGINT and SIGTERM stay as they are.
// Throws Error: config out of range, no such driver or output, another driver is in use in this process.
std::unique_ptr<VibrationSink> open_audio_sink(const AudioSinkConfig& config);

}  // namespace asperity
