#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace asperity {

// The causal counterpart of force_scale.h: 1 - (f - mean)/(max - min), f after an exponential average and mean, maximum
// and minimum of what has come so far.
class RunningForceScale {
 public:
  explicit RunningForceScale(double window_s) : window_s_(window_s) {}

  // 1 without a force, and while the force has not changed.
  double factor(double force_N, std::int64_t t_ns) {
    if (!std::isfinite(force_N)) return 1.0;
    if (count_ == 0.0) smooth_N_ = low_N_ = high_N_ = force_N;
    const double step_s = count_ == 0.0 ? 0.0 : std::max(0.0, static_cast<double>(t_ns - last_ns_) * 1e-9);
    last_ns_ = t_ns;
    smooth_N_ += (window_s_ > 0.0 ? 1.0 - std::exp(-step_s / window_s_) : 1.0) * (force_N - smooth_N_);
    count_ += 1.0;
    mean_N_ += (smooth_N_ - mean_N_) / count_;
    low_N_ = std::min(low_N_, smooth_N_);
    high_N_ = std::max(high_N_, smooth_N_);
    return high_N_ > low_N_ ? 1.0 - (smooth_N_ - mean_N_) / (high_N_ - low_N_) : 1.0;
  }

 private:
  double window_s_;
  double count_ = 0.0;
  std::int64_t last_ns_ = 0;
  double smooth_N_ = 0.0, mean_N_ = 0.0, low_N_ = 0.0, high_N_ = 0.0;
};

}  // namespace asperity
