#include "asperity/trajectory/estimate_trajectory_ekf.h"

#include "asperity/base/error.h"
#include "causal_feed.h"
#include "forward_filter.h"
#include "fused_setup.h"
#include "noise_scale.h"

namespace asperity {

using inertial_smoother::CausalFeed;
using inertial_smoother::CausalMotion;
using inertial_smoother::Checkpoint;
using inertial_smoother::StepFilter;

TrajectoryResult estimate_trajectory_ekf(const Recording& recording, const FusedConfig& model,
                                         const CausalFeedConfig& config, const Observer& observer) {
  CausalFeed feed(recording, model, config);
  const Eigen::Vector3d& tip_m = recording.calibration.tip_in_marker_m;
  CausalMotion out(recording.calibration);
  NoiseScale scale(model.process_noise_scale);
  Checkpoint at;
  bool started = false;
  std::size_t poses = 0;
  while (feed.next()) {
    inertial_smoother::Problem window = feed.problem();
    window.process_scale = scale.factor();
    if (!started) {
      at.x = window.start;
      at.P = window.start_covariance;
    } else {
      window.start = at.x;
      window.start_covariance = at.P;
      window.refused_in_a_row = at.refused_in_a_row;
    }
    StepFilter filter(window);
    if (window.epochs.front().pose >= 0) at = filter.update(0, at).checkpoint;
    for (std::size_t e = 1; e < window.epochs.size(); ++e) {
      const Checkpoint before = filter.predict(e, at);
      if (started) {
        out.append(feed, e, inertial_smoother::dead_reckon(window, e, at.x, tip_m),
                   inertial_smoother::tip_covariance(at, window, tip_m),
                   inertial_smoother::tip_covariance(before, window, tip_m), {}, at.x.latency);
      }
      const bool measured = window.epochs[e].pose >= 0;
      poses += measured;
      at = measured ? filter.update(e, before).checkpoint : before;
    }
    if (!at.x.p.allFinite() || !at.P.allFinite()) {
      throw Error("the trajectory's estimate is not finite: check the calibration's magnitudes");
    }
    window.checkpoint_epoch = window.epochs.size() - 1;
    if (started) at = scale.judge(window, at);
    started = true;
    observer.update("filter", static_cast<double>(feed.first_row()) / static_cast<double>(recording.probe.size()));
  }
  TrajectoryResult result;
  result.motion = std::move(out.motion);
  if (result.motion.size() == 0) throw Error("tracker.csv: the poses end before the filter has begun");
  result.metrics["poses_used"] = static_cast<double>(poses);
  result.metrics["process_noise_scale"] = scale.factor();
  result.metrics["latency_s"] = recording.calibration.tracker.latency_s + at.x.latency;
  return result;
}

}  // namespace asperity
