#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/calibration/accelerometer_samples.h"

namespace asperity {

struct FindStaticPosesConfig {
  double window_s = 0.5;
  double shortest_s = 1.0;
  double still_counts = 0.0;
  double same_pose = 0.02;

  template <class V>
  void visit(V& v) {
    v.field("window_s", window_s, "stretch over which the readings' variance is taken, s", {0.01, 60.0});
    v.field("shortest_s", shortest_s, "shortest rest that counts as a pose, s", {0.01, 3600.0});
    v.field("still_counts", still_counts, "standard deviation below which the probe is still; 0: found from the data",
            {0.0, 1e12});
    v.field("same_pose", same_pose,
            "successive static intervals with means nearer than this are one pose, share of the readings' radius",
            {0.0, 1.0});
  }
};

// A static interval: rows first to last (exclusive).
struct StaticPose {
  std::size_t first = 0;
  std::size_t last = 0;
  double start_s = 0.0;
  double duration_s = 0.0;
  Eigen::Vector3d mean_counts = Eigen::Vector3d::Zero();
  double drift_counts = 0.0;  // distance of the means of its halves
};

struct StaticPoses {
  std::vector<StaticPose> poses;
  double still_counts = 0.0;   // the threshold that was used, on the root of the three variances' sum
  double noise_counts = 0.0;   // median of the same over the static windows
  double radius_counts = 0.0;  // the poses' spread: RMS distance of their means from the mean of these
};

// The stretches in which the sensor was held still, from its readings alone: the variance of the counts, summed over
// the axes, in a window round each row stays below a threshold. Log variances of windows have two heaps, rest and
// motion; the threshold is where Otsu's criterion (1979) parts them best, but never below four times the median
// variance of the quiet heap, which is what chance alone does to a window. A window that is not filled (rows lost) is
// not still. Throws Error for fewer than 20 rows, for times that do not rise and for readings that are not finite.
StaticPoses find_static_poses(const AccelerometerSamples& samples, const FindStaticPosesConfig& config = {});

}  // namespace asperity
