#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "asperity/recording/calibration.h"
#include "asperity/simulation/simulated_camera_config.h"

namespace asperity {

enum class TagBody { kFront, kRing };
inline constexpr std::array<std::string_view, 2> kTagBodyNames = {"front", "ring"};

// The bench as hardware: the links between a simulated scan and the bytes and images that leave it.
struct LiveBenchConfig {
  SimulatedCameraConfig camera;
  TagBody body = TagBody::kFront;
  double stamp_jitter_s = 0.1e-3;  // of a frame's time stamp; its latency is simulation.tracker.latency_s
  double probe_clock_start_s = 37.25;
  double probe_clock_fast_ppm = 35.0;
  double flip_chance = 0.0;  // that a byte of the probe arrives with one bit flipped
  double drop_chance = 0.0;  // that a byte of the probe is lost
  double insert_chance = 0.0;
  std::int64_t link_seed = 1;
  double wait_s = 60.0;          // for the readers
  double settle_s = 0.2;         // between the readers' coming and the first sample
  double linger_s = 2.0;         // for the probe's reader to take the last bytes
  double drop_after_s = 3600.0;  // a frame that is this late is dropped, as a camera drops what nobody fetches

  template <class V>
  void visit(V& v) {
    v.group("camera", camera);
    v.choice("body", body, kTagBodyNames, "tags on the probe: two on its front, or six around it");
    v.field("stamp_jitter_s", stamp_jitter_s, "jitter of a frame's time stamp, s rms", {0.0, 0.1});
    v.field("probe_clock_start_s", probe_clock_start_s, "what the probe's clock shows at first, s", {0.0, 1e9});
    v.field("probe_clock_fast_ppm", probe_clock_fast_ppm, "what it gains, ppm", {-1e4, 1e4});
    v.field("flip_chance", flip_chance, "chance that a byte of the probe arrives with one bit flipped", {0.0, 1.0});
    v.field("drop_chance", drop_chance, "chance that a byte of the probe is lost", {0.0, 1.0});
    v.field("insert_chance", insert_chance, "chance that a random byte comes before a byte of the probe", {0.0, 1.0});
    v.field("link_seed", link_seed, "of the link's faults", {0.0, 9e15});
    v.field("wait_s", wait_s, "longest wait for the readers, s", {0.0, 3600.0});
    v.field("settle_s", settle_s, "between the readers' coming and the first sample, s", {0.0, 60.0});
    v.field("linger_s", linger_s, "for the probe's reader to take the last bytes, s", {0.0, 60.0});
    v.field("drop_after_s", drop_after_s, "a frame that is later than this behind its time stamp is dropped, s",
            {0.0, 3600.0});
  }
};

// The tags on the probe, exactly as they are.
std::vector<MarkerPlacement> tag_body(const LiveBenchConfig& config);

}  // namespace asperity
