#include "asperity/pipeline/recorded_series.h"

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/signal/resample.h"

namespace asperity {

RecordedSeries recorded_series(const ProcessResult& result) {
  const TipMotion& motion = result.trajectory.motion;
  const std::size_t n = motion.size();
  if (n < 2 || motion.a_world_tip_mps2.size() != n || result.base.path.n_world.size() != n) {
    throw Error("series: the recording gives no acceleration along a surface's normal");
  }
  std::vector<double> t_s(n), acceleration(n), speed(n), read_s, read_N;
  for (std::size_t i = 0; i < n; ++i) {
    t_s[i] = static_cast<double>(motion.t_ns[i] - motion.t_ns[0]) * kNanosecond_s;
    acceleration[i] = result.base.path.n_world[i].dot(motion.a_world_tip_mps2[i]);
    speed[i] = result.base.contact[i] != 0 ? result.base.speed_mps[i] : 0.0;
    if (i < motion.force_N.size() && std::isfinite(motion.force_N[i])) {
      read_s.push_back(t_s[i]);
      read_N.push_back(motion.force_N[i]);
    }
  }
  if (read_s.size() < 2) throw Error("series: the recording has no force");
  constexpr double kForceHole_s = 0.05;
  RecordedSeries out;
  out.rate_Hz = static_cast<double>(n - 1) / t_s.back();
  const double step_s = 1.0 / out.rate_Hz;
  out.acceleration_mps2 = resample_uniform(t_s, acceleration, 0.0, step_s, n);
  out.speed_mps = resample_uniform(t_s, speed, 0.0, step_s, n);
  out.force_N = resample_uniform(read_s, read_N, 0.0, step_s, n, kForceHole_s);
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(out.acceleration_mps2[i])) out.acceleration_mps2[i] = 0.0;
    if (!std::isfinite(out.speed_mps[i])) out.speed_mps[i] = 0.0;
    if (!std::isfinite(out.force_N[i])) out.force_N[i] = 0.0;
  }
  return out;
}

}  // namespace asperity
