#pragma once

#include "asperity/recording/recording.h"
#include "asperity/trajectory/object_motion.h"

namespace asperity {

struct ObjectSmootherConfig {
  double gate_chi2 = 16.8;
  double longest_gap_s = 0.2;
  double slow_share = 0.2;
  double slow_time_s = 1.0;
  int passes = 12;

  template <class V>
  void visit(V& v) {
    v.field("gate_chi2", gate_chi2, "a pose of the object farther off (squared, 3 degrees of freedom) loses weight",
            {3, 1e6});
    v.field("longest_gap_s", longest_gap_s, "longest time without a pose of the object that is interpolated, s",
            {0.0, 10.0});
    v.field("slow_share", slow_share,
            "the tracker's drift as a share of its white noise, where its calibration states none", {0, 100});
    v.field("slow_time_s", slow_time_s, "its time constant, s", {0.01, 1000});
    v.field("passes", passes, "filter-smoother passes at most, in which the noise is learnt", {2, 100});
  }
};

// The motion of a tracked body from its poses alone: an error-state filter with constant velocity and constant angular
// velocity, disturbed by white acceleration, and a fixed-interval smoother (Rauch, Tung and Striebel, 1965), positions
// and rotations apart. The density of the acceleration and the poses' noise are learnt for each world axis from the
// likelihood; a pose that disagrees loses its weight (docs/moving-object.md). `latency_s`: the tracker's; a pose was
// taken that long before its t_ns, and the result's times are those. The noise of a pose is its own, or by the
// calibration's law, or the calibration's for all. Throws Error for fewer than four poses.
ObjectMotion smooth_object_motion(const TrackerStream& poses, const Calibration& calibration, const RecordingInfo& info,
                                  double latency_s, const ObjectSmootherConfig& config = {});

}  // namespace asperity
