#include "asperity/simulation/bench_camera.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/random.h"
#include "streams.h"

namespace asperity {

BenchCamera::BenchCamera(const SimulatedCameraConfig& config, const std::vector<MarkerPlacement>& body,
                         const Recording& recording, double latency_s, double jitter_s)
    : motion_(recording), renderer_(config, body) {
  Random random(static_cast<std::uint64_t>(config.seed), stream(Stream::kFrameTimes));
  const double phase = random.uniform();
  const auto exposure_ns = static_cast<std::int64_t>(std::llround(config.exposure_s * 1e9));
  std::int64_t last_ns = 0;
  for (std::int64_t k = 0;; ++k) {
    FrameTime time;
    time.open_ns = motion_.start_ns() + std::llround((static_cast<double>(k) + phase) / config.rate_Hz * 1e9);
    time.close_ns = time.open_ns + exposure_ns;
    if (time.close_ns > motion_.end_ns()) break;
    time.stamp_ns = time.middle_ns() + std::llround(1e9 * (latency_s + jitter_s * random.normal()));
    // A driver's time stamps rise, and a frame is not there before it was exposed.
    time.stamp_ns = std::max({time.stamp_ns, time.middle_ns(), last_ns + 1});
    last_ns = time.stamp_ns;
    times_.push_back(time);
  }
}

void BenchCamera::render(std::size_t frame, GrayImage& image) {
  const FrameTime& time = times_[frame];
  renderer_.render(motion_.T_world_marker(time.open_ns), motion_.T_world_marker(time.close_ns), frame, image);
}

TrackerStream BenchCamera::true_poses() const {
  TrackerStream out;
  for (const FrameTime& time : times_) {
    out.t_ns.push_back(time.stamp_ns);
    out.T_world_marker.push_back(motion_.T_world_marker(time.middle_ns()));
  }
  return out;
}

}  // namespace asperity
