#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "asperity/device/haptic_device.h"

namespace asperity {

struct ReplaySample {
  std::int64_t t_ns = 0;
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
};

// A device without a hand, whose point goes where it was: at a sample's time exactly there, between two samples on
// the straight line, with that line's velocity. Times are relative to the first sample, which is at the schedule's
// time 0. Forces are taken and do nothing. Readings after the last sample are kEnded and stay there.
// Throws Error for no sample, times that do not rise or are not within ±2^61 ns, and positions that are not finite.
std::unique_ptr<HapticDevice> open_replay(std::vector<ReplaySample> samples);

}  // namespace asperity
