#include "noise_scale.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr double kStep = 4.0;
constexpr double kLowest = 0.3;  // as the batch's: the sensors' own noise is a floor
constexpr double kHighest = 1e5;
constexpr double kMemory_s = 1.5;
constexpr double kSure = 3.0;  // of log-likelihood

}  // namespace

inertial_smoother::Checkpoint NoiseScale::judge(const inertial_smoother::Problem& window,
                                                const inertial_smoother::Checkpoint& checkpoint) {
  if (fixed_ || window.checkpoint_epoch == 0) return checkpoint;
  if (!running_) {
    running_ = true;
    for (Rival& rival : rivals_) rival = {{window.start, window.start_covariance, window.refused_in_a_row}, 0.0};
  }
  inertial_smoother::Problem part = window;
  part.epochs.resize(window.checkpoint_epoch + 1);
  part.knots.shorten(part.epochs.back().knot + 1);
  const double keep = std::exp(-(part.knots.back().t - part.knots.front().t) / kMemory_s);
  const std::array<double, 3> factors{std::max(kLowest, factor_ / kStep), factor_, std::min(kHighest, factor_ * kStep)};
  for (std::size_t k = 0; k < rivals_.size(); ++k) {
    Rival& rival = rivals_[k];
    part.process_scale = factors[k];
    part.start = rival.state.x;
    part.start_covariance = rival.state.P;
    part.refused_in_a_row = rival.state.refused_in_a_row;
    const inertial_smoother::Filtered filtered = inertial_smoother::filter_motion(part);
    rival.state = filtered.checkpoint;
    rival.score = keep * rival.score + filtered.log_likelihood;
  }
  const std::size_t better = rivals_[2].score > rivals_[0].score ? 2 : 0;
  const bool sound = rivals_[better].state.x.p.allFinite() && rivals_[better].state.P.allFinite();
  if (!sound || !(rivals_[better].score > rivals_[1].score + kSure)) return checkpoint;
  factor_ = factors[better];
  const Rival winner{rivals_[better].state, 0.0};
  rivals_.fill(winner);
  return winner.state;
}

}  // namespace asperity
