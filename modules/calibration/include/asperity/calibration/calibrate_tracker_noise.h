#pragma once

#include <span>
#include <string>
#include <vector>

#include "asperity/calibration/tracker_noise.h"
#include "asperity/recording/recording.h"

namespace asperity {

// A tracker's poses with the data that give the distance and the tilt of the tags.
struct StaticTracker {
  std::string name;
  const TrackerStream* tracker = nullptr;
  std::vector<MarkerPlacement> markers;  // empty: one tag in the marker frame's own plane
  bool world_is_camera = true;
};

struct TrackerNoiseConfig {
  double least_rest_s = 5.0;
  int least_poses = 100;
  double block_s = 0.25;
  double rest_position_m = 0.002;
  double rest_rotation_rad = 0.02;
  double largest_gap_s = 0.5;
  double outlier_sigmas = 8.0;
  double least_distance_ratio = 1.3;
  double least_tilt_ratio = 1.1;

  template <class V>
  void visit(V& v) {
    v.field("least_rest_s", least_rest_s, "shorter static intervals are not used, s", {0.1, 3600.0});
    v.field("least_poses", least_poses, "static intervals with fewer poses are not used", {16, 1000000});
    v.field("block_s", block_s, "poses are averaged over this long to see whether the body moves, s", {0.01, 60.0});
    v.field("rest_position_m", rest_position_m, "in a static interval the averages stay within this of their mean, m",
            {0.0, 1.0});
    v.field("rest_rotation_rad", rest_rotation_rad, "and the averaged rotations within this, rad", {0.0, 3.0});
    v.field("largest_gap_s", largest_gap_s, "a static interval ends where no pose arrives for longer, s", {0.01, 60.0});
    v.field("outlier_sigmas", outlier_sigmas, "poses further off (robust standard deviations) are left out",
            {4.0, 1e6});
    v.field("least_distance_ratio", least_distance_ratio,
            "the model needs static intervals whose distances differ by this factor", {1.0, 100.0});
    v.field("least_tilt_ratio", least_tilt_ratio,
            "its tilt needs static intervals whose cosines of tilt differ by this factor", {1.0, 100.0});
  }
};

// The tracker's noise from recordings in which the marker body rests (thesis §3.5, Fig. 9): rests are found, the
// scatter of each is taken apart into white and slow (series_noise.h), and with several places the
// white part's law over distance and tilt is fitted (docs/calibration-optics.md). Throws Error, saying what to record
// instead, if no static interval is long enough, and as check_independent() does.
TrackerNoise calibrate_tracker_noise(std::span<const StaticTracker> recordings, const TrackerNoiseConfig& config = {});

}  // namespace asperity
