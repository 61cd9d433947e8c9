#pragma once

#include <cstdint>

namespace asperity {

// One random stream for each consumer, so that a change to one leaves the others' draws as they were.
enum class Stream : std::uint64_t {
  kSurface = 1,
  kPath,
  kSpeed,
  kForce,
  kLateral,
  kNormal,
  kAlong,
  kWander,
  kTremor,
  kAccelNoise,
  kGyroNoise,
  kForceNoise,
  kProbeClock,
  kRadio,
  kTrackerNoise,
  kTrackerClock,
  kTrackerFaults,
  kSensorTruth,
  kCalibration,
  kGravity,
  kBackground,
  kCalibrationMotion,
  kLink,
  kBoards,
  kFrameTimes,
  kCameraNoise,
  kProbeWander,
  kFlicker,
  kWarming,
  kForce3Noise,
  kForce3Truth,
  kForce3Calibration,
  kTrackerSlow,
  kTrackerWander,
  kObjectMotion,
};

constexpr std::uint64_t stream(Stream s) { return static_cast<std::uint64_t>(s); }

}  // namespace asperity
