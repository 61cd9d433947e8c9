#include "asperity/pipeline/measure_accuracy.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/pipeline/true_profile.h"
#include "asperity/signal/statistics.h"
#include "process_stages.h"

namespace asperity {

namespace {

// Positions at rising times, read in between by straight lines at rising query times.
class Track {
 public:
  Track(const std::vector<std::int64_t>& t_ns, const std::vector<Eigen::Vector3d>& p_m) : t_ns_(t_ns), p_m_(p_m) {}

  bool covers(std::int64_t t_ns) const { return t_ns >= t_ns_.front() && t_ns <= t_ns_.back(); }

  // The first sample not before t_ns, for query times that do not fall.
  std::size_t advance(std::int64_t t_ns) {
    while (next_ + 1 < t_ns_.size() && t_ns_[next_] < t_ns) ++next_;
    return next_;
  }

  Eigen::Vector3d at(std::int64_t t_ns) {
    advance(t_ns);
    const std::size_t before = next_ == 0 ? 0 : next_ - 1;
    const std::size_t after = next_;
    if (before == after) return p_m_[after];
    const double t = static_cast<double>(t_ns - t_ns_[before]) / static_cast<double>(t_ns_[after] - t_ns_[before]);
    return p_m_[before] + t * (p_m_[after] - p_m_[before]);
  }

 private:
  const std::vector<std::int64_t>& t_ns_;
  const std::vector<Eigen::Vector3d>& p_m_;
  std::size_t next_ = 0;
};

bool has_heights(const Truth& truth) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    count += std::isfinite(truth.height_m[i]) && std::isfinite(truth.s_m[i]) ? 1 : 0;
  return count >= 8;
}

// Way over time where the truth travels: rests would lower the speed.
double travel_speed_mps(const Truth& truth) {
  constexpr double kRest_mps = 1e-3;
  double way_m = 0.0;
  double time_s = 0.0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const double step_s = static_cast<double>(truth.t_ns[i] - truth.t_ns[i - 1]) * kNanosecond_s;
    const double step_m = truth.s_m[i] - truth.s_m[i - 1];
    if (!(step_m > kRest_mps * step_s)) continue;
    way_m += step_m;
    time_s += step_s;
  }
  return time_s > 0.0 ? way_m / time_s : 0.0;
}

// The place of an end of the truth, `s_m` in order from the outer end: the median of the samples within a tenth of a
// second, about a period of a hand's tremor, which at rest would make the lowest and the highest true place too far
// apart. A tip that travels there is not at rest: its outermost place.
double end_place_m(const std::vector<double>& s_m) {
  constexpr double kResting_m = 0.5e-3;  // tremor and creep go less far
  return std::abs(s_m.back() - s_m.front()) < kResting_m ? median(s_m) : s_m.front();
}

// Between the places of the first and the last tenth of a second in contact. nan if there is none.
double true_length_m(const Truth& truth) {
  constexpr std::int64_t kEnd_ns = 100'000'000;
  std::size_t first = 0, last = truth.size();
  while (first < last && !(truth.force_N[first] > 0.0 && std::isfinite(truth.s_m[first]))) ++first;
  while (last > first && !(truth.force_N[last - 1] > 0.0 && std::isfinite(truth.s_m[last - 1]))) --last;
  if (last == first) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> begin_m, end_m;
  for (std::size_t i = first; i < last && truth.t_ns[i] - truth.t_ns[first] <= kEnd_ns; ++i) {
    if (std::isfinite(truth.s_m[i])) begin_m.push_back(truth.s_m[i]);
  }
  for (std::size_t i = last; i > first && truth.t_ns[last - 1] - truth.t_ns[i - 1] <= kEnd_ns; --i) {
    if (std::isfinite(truth.s_m[i - 1])) end_m.push_back(truth.s_m[i - 1]);
  }
  return end_place_m(end_m) - end_place_m(begin_m);
}

// The true heights, nan where the tip was off the surface for longer than a bounce: there is no surface in
// them to compare with.
std::vector<double> heights_in_contact(const Truth& truth) {
  constexpr std::int64_t kBounce_ns = 20'000'000;
  std::vector<double> out = truth.height_m;
  for (std::size_t i = 0; i < truth.size();) {
    std::size_t end = i;
    while (end < truth.size() && truth.force_N[end] <= 0.0) ++end;
    if (end > i && truth.t_ns[end - 1] - truth.t_ns[i] > kBounce_ns) {
      std::fill(out.begin() + static_cast<std::ptrdiff_t>(i), out.begin() + static_cast<std::ptrdiff_t>(end),
                std::numeric_limits<double>::quiet_NaN());
    }
    i = end + 1;
  }
  return out;
}

// The true heights in contact, resampled as a profile is, without a high-pass.
Profile true_heights(Truth truth, double spacing_m, double max_hole_m) {
  truth.height_m = heights_in_contact(truth);
  ProfileConfig config;
  config.spacing_m = spacing_m;
  config.max_hole_m = max_hole_m;
  config.cutoff_cycles_per_mm = 0.0;
  return true_profile(truth, config);
}

}  // namespace

Accuracy measure_accuracy(const Recording& recording, const TipMotion& motion, const Profile& profile,
                          const ComparisonConfig& config, const TextureOf& texture_of) {
  if (!recording.truth) throw Error("measure_accuracy: the recording has no truth");
  const Truth& truth = *recording.truth;
  const TrackerStream& tracker = recording.tracker;
  if (motion.size() == 0 || tracker.size() == 0) throw Error("measure_accuracy: no motion or no poses");

  const auto latency_ns =
      static_cast<std::int64_t>(std::llround(recording.calibration.tracker.latency_s / kNanosecond_s));
  std::vector<std::int64_t> pose_t_ns(tracker.t_ns);
  std::vector<Eigen::Vector3d> pose_tip_m;
  pose_tip_m.reserve(tracker.size());
  for (std::int64_t& t_ns : pose_t_ns) t_ns -= latency_ns;
  for (const Pose& T_world_marker : tracker.T_world_marker) {
    pose_tip_m.push_back(T_world_marker * recording.calibration.tip_in_marker_m);
  }

  Track estimate(motion.t_ns, motion.p_world_tip_m);
  Track raw(pose_t_ns, pose_tip_m);
  Accuracy out;
  double estimate_sum = 0.0;
  double raw_sum = 0.0;
  double normalised_sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const std::int64_t t_ns = truth.t_ns[i];
    if (!estimate.covers(t_ns) || !raw.covers(t_ns)) continue;
    const double square_m2 = (estimate.at(t_ns) - truth.p_world_tip_m[i]).squaredNorm();
    estimate_sum += square_m2;
    if (!motion.cov_world_tip_m2.empty()) {
      normalised_sum += square_m2 / motion.cov_world_tip_m2[estimate.advance(t_ns)].trace();
    }
    raw_sum += (raw.at(t_ns) - truth.p_world_tip_m[i]).squaredNorm();
    ++out.compared;
  }
  if (out.compared == 0) throw Error("measure_accuracy: the truth and the motion do not overlap in time");
  out.position_rms_m = std::sqrt(estimate_sum / static_cast<double>(out.compared));
  if (!motion.cov_world_tip_m2.empty()) {
    out.position_error_over_sigma = std::sqrt(normalised_sum / static_cast<double>(out.compared));
  }
  out.tracker_rms_m = std::sqrt(raw_sum / static_cast<double>(out.compared));

  if (has_heights(truth)) {
    const ProbeStream& probe = recording.probe;
    const double span_s = static_cast<double>(probe.t_ns.back() - probe.t_ns.front()) * kNanosecond_s;
    const double speed_mps = travel_speed_mps(truth);
    ComparisonConfig comparison = config;
    if (span_s > 0.0 && speed_mps > 0.0) {
      const double rate_Hz = static_cast<double>(probe.size() - 1) / span_s;
      comparison.high_cycles_per_mm =
          std::min(config.high_cycles_per_mm, comparison_limit_cycles_per_mm(rate_Hz, speed_mps));
    }
    out.band_high_cycles_per_mm = comparison.high_cycles_per_mm;
    AlignedProfiles aligned;
    if (texture_of) {
      const Profile expected = true_heights(truth, profile.spacing_m, comparison.max_hole_m);
      aligned = align_profiles(profile.s_m, profile.texture_m, expected.s_m, texture_of(expected.height_m), comparison);
    } else {
      aligned = align_profiles(profile.s_m, profile.height_m, truth.s_m, heights_in_contact(truth), comparison);
    }
    out.profile = aligned.comparison;
    const double true_m = true_length_m(truth);
    if (true_m > 0.0) out.profile->length_error_percent = 100.0 * (measure_coverage(profile).length_m / true_m - 1.0);
    out.heights = std::move(aligned.heights);
  }
  return out;
}

}  // namespace asperity
