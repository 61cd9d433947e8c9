#pragma once

#include <string>

namespace asperity {

// What a sink is, in words.
struct VibrationInfo {
  std::string name;   // "audio", "gamepad"
  std::string model;  // as the driver calls it
};

// Something that vibrates but has no position: a voice coil at a sound card, a gamepad's motors. It stands beside a
// device that has one. Its destructor fades it out and closes it.
class VibrationSink {
 public:
  virtual ~VibrationSink() = default;

  virtual const VibrationInfo& info() const noexcept = 0;

  // The force of one servo tick, N, at the rate the sink was opened for. One thread alone; neither allocates, locks,
  // throws nor waits. A force that is not a number counts as none: the sink fades out as if nothing had come.
  virtual void push(double force_N) noexcept = 0;

  // False once the driver has lost it; it takes nothing any more. The pushing thread alone.
  virtual bool working() const noexcept = 0;

  // Fades out, and no sound from now on. Does not throw; may wait.
  virtual void close() noexcept = 0;

  // What went wrong, in words, once working() is false; empty if nothing did. Not for the servo thread.
  virtual std::string fault() const = 0;

 protected:
  VibrationSink() = default;
  VibrationSink(const VibrationSink&) = default;
  VibrationSink& operator=(const VibrationSink&) = default;
};

}  // namespace asperity
