#include "asperity/trajectory/synchronise_streams.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/signal/resample.h"

namespace asperity {
namespace {

double seconds(std::int64_t duration_ns) { return static_cast<double>(duration_ns) * kNanosecond_s; }

void check_rising(const std::vector<std::int64_t>& t_ns, const char* stream) {
  for (std::size_t i = 1; i < t_ns.size(); ++i) {
    if (t_ns[i] <= t_ns[i - 1]) {
      throw Error(std::string(stream) + " sample " + std::to_string(i) + ": time " + std::to_string(t_ns[i]) +
                  " ns does not follow " + std::to_string(t_ns[i - 1]) + " ns");
    }
  }
}

struct Series {
  std::vector<double> t_s;
  std::vector<double> value;
};

// The poses at the rising times `at_s`, all between the first and the last of t_s.
std::vector<Pose> interpolate_poses(const std::vector<double>& t_s, const std::vector<Pose>& poses,
                                    const std::vector<double>& at_s) {
  std::vector<Pose> out;
  out.reserve(at_s.size());
  std::size_t k = 0;
  for (const double at : at_s) {
    while (k + 2 < t_s.size() && t_s[k + 1] <= at) ++k;
    const double part = std::clamp((at - t_s[k]) / (t_s[k + 1] - t_s[k]), 0.0, 1.0);
    out.push_back({slerp(poses[k].rotation, poses[k + 1].rotation, part),
                   lerp(poses[k].translation_m, poses[k + 1].translation_m, part)});
  }
  return out;
}

}  // namespace

SynchronisedStreams synchronise_streams(const ProbeStream& probe, const Outliers& outliers,
                                        const TrackerStream& tracker, double latency_s, std::int64_t period_ns,
                                        bool average) {
  if (period_ns <= 0) throw Error("synchronisation period must be positive, not " + std::to_string(period_ns) + " ns");
  if (!std::isfinite(latency_s)) throw Error("tracker latency is " + number_text(latency_s) + " s");
  if (probe.size() < 2 || tracker.size() < 2) {
    throw Error("synchronisation needs two samples of each stream; there are " + std::to_string(probe.size()) +
                " of the probe and " + std::to_string(tracker.size()) + " of the tracker");
  }
  check_rising(probe.t_ns, "probe");
  check_rising(tracker.t_ns, "tracker");

  // Times in seconds from the probe's first sample: differences keep their digits.
  const std::int64_t origin_ns = probe.t_ns.front();
  Series axis[3], force;
  for (std::size_t i = 0; i < probe.size(); ++i) {
    if (outliers.rejected[i]) continue;
    const double t_s = seconds(probe.t_ns[i] - origin_ns);
    for (int k = 0; k < 3; ++k) {
      if (std::isnan(probe.accel_counts[i][k])) continue;
      axis[k].t_s.push_back(t_s);
      axis[k].value.push_back(probe.accel_counts[i][k]);
    }
    if (!std::isnan(probe.force_counts[i])) {
      force.t_s.push_back(t_s);
      force.value.push_back(probe.force_counts[i]);
    }
  }
  for (const Series& s : axis) {
    if (s.value.size() < 2) throw Error("synchronisation: fewer than two usable samples of the accelerometer");
  }
  std::vector<double> tracker_s;
  tracker_s.reserve(tracker.size());
  for (const std::int64_t t_ns : tracker.t_ns) tracker_s.push_back(seconds(t_ns - origin_ns) - latency_s);

  const double begin_s = std::max({axis[0].t_s.front(), axis[1].t_s.front(), axis[2].t_s.front(), tracker_s.front()});
  const double end_s = std::min({axis[0].t_s.back(), axis[1].t_s.back(), axis[2].t_s.back(), tracker_s.back()});
  const double period_s = seconds(period_ns);
  if (!(end_s - begin_s >= period_s)) {
    throw Error("the probe's and the tracker's streams share less than " + number_text(period_s) + " s");
  }
  const auto count = static_cast<std::size_t>(std::floor((end_s - begin_s) / period_s)) + 1;
  // A handful of samples hours apart must not take the memory of a day.
  constexpr double kMostPeriodsPerSample = 1000.0;
  constexpr double kFewPeriods = 1e6;
  const auto samples = static_cast<double>(std::min(probe.size(), tracker.size()));
  if (static_cast<double>(count) > std::max(kFewPeriods, kMostPeriodsPerSample * samples)) {
    throw Error("synchronisation: " + std::to_string(count) + " periods of " + number_text(period_s) +
                " s are too many for " + number_text(samples) + " samples of a stream");
  }
  const auto begin_ns = static_cast<std::int64_t>(std::ceil(begin_s / kNanosecond_s));

  SynchronisedStreams out;
  std::vector<double> at_s;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t t_ns = begin_ns + static_cast<std::int64_t>(i) * period_ns;
    if (seconds(t_ns) > end_s) break;
    out.t_ns.push_back(origin_ns + t_ns);
    at_s.push_back(seconds(t_ns));
  }
  std::vector<double> counts[3];
  for (int k = 0; k < 3; ++k) {
    counts[k] = average ? interval_means(axis[k].t_s, axis[k].value, at_s, period_s)
                        : interpolate(axis[k].t_s, axis[k].value, at_s);
  }
  out.force_counts = bridge_gaps(interpolate(force.t_s, force.value, at_s));
  for (std::size_t i = 0; i < at_s.size(); ++i) out.accel_counts.emplace_back(counts[0][i], counts[1][i], counts[2][i]);
  out.T_world_marker = interpolate_poses(tracker_s, tracker.T_world_marker, at_s);
  return out;
}

}  // namespace asperity
