#include "asperity/pipeline/measure_repeatability.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/units.h"

namespace asperity {

namespace {

MeanAndSpread mean_and_spread(std::span<const double> values) {
  MeanAndSpread out;
  out.count = values.size();
  if (values.empty()) return out;
  double sum = 0.0, square = 0.0;
  for (const double value : values) sum += value;
  out.mean = sum / static_cast<double>(values.size());
  for (const double value : values) square += (value - out.mean) * (value - out.mean);
  if (values.size() > 1) out.deviation = std::sqrt(square / static_cast<double>(values.size() - 1));
  return out;
}

double common_limit(std::span<const RepeatedScan> scans, const ComparisonConfig& config) {
  double limit = config.high_cycles_per_mm;
  for (const RepeatedScan& scan : scans) {
    if (scan.speed_mps > 0.0 && scan.probe_rate_Hz > 0.0)
      limit = std::min(limit, comparison_limit_cycles_per_mm(scan.probe_rate_Hz, scan.speed_mps));
  }
  return limit;
}

// Heights at the points of `s_m`, which are whole multiples of the spacing as those of `heights` are.
std::vector<double> on_points(const std::vector<double>& s_m, const ComparedHeights& heights, double spacing_m) {
  std::vector<double> out(s_m.size(), kNan);
  if (s_m.empty()) return out;
  const auto cell = [&](double s) { return std::llround(s / spacing_m); };
  const auto first = cell(s_m.front());
  for (std::size_t i = 0; i < heights.s_m.size(); ++i) {
    const auto k = cell(heights.s_m[i]) - first;
    if (k >= 0 && k < static_cast<long long>(out.size())) out[static_cast<std::size_t>(k)] = heights.measured_m[i];
  }
  return out;
}

void measure_spread(Repeatability& out) {
  double square = 0.0, count = 0.0;
  std::vector<double> here(out.height_m.size());
  for (std::size_t i = 0; i < out.s_m.size(); ++i) {
    for (std::size_t scan = 0; scan < here.size(); ++scan) here[scan] = out.height_m[scan][i];
    const bool all = std::all_of(here.begin(), here.end(), [](double h) { return std::isfinite(h); });
    const MeanAndSpread of = all ? mean_and_spread(here) : MeanAndSpread{};
    out.mean_m.push_back(of.mean);
    out.deviation_m.push_back(of.deviation);
    if (!all) continue;
    square += of.deviation * of.deviation;
    count += 1.0;
  }
  if (count > 0.0) out.spread_rms_m = std::sqrt(square / count);
}

}  // namespace

RepeatedScan repeated_scan(const ProcessResult& result, const Recording& recording) {
  const std::vector<std::int64_t>& t_ns = recording.probe.t_ns;
  const double span_s = t_ns.size() < 2 ? 0.0 : static_cast<double>(t_ns.back() - t_ns.front()) * kNanosecond_s;
  const double rate_Hz = span_s > 0.0 ? static_cast<double>(t_ns.size() - 1) / span_s : 0.0;
  return {result.profile, result.periodicity, result.speed.mean_mps, rate_Hz};
}

Repeatability measure_repeatability(std::span<const RepeatedScan> scans, const ComparisonConfig& config) {
  constexpr std::size_t kMost = 64;
  if (scans.size() < 2 || scans.size() > kMost) {
    throw Error("repeatability: " + std::to_string(scans.size()) + " scans; 2 to " + std::to_string(kMost) +
                " can be compared");
  }
  ComparisonConfig common = config;
  common.high_cycles_per_mm = common_limit(scans, config);
  Repeatability out;
  out.band_high_cycles_per_mm = common.high_cycles_per_mm;
  const Profile& first = scans.front().profile;
  std::vector<double> pitches_m, depths_m, correlations;
  for (const RepeatedScan& scan : scans) {
    const AlignedProfiles aligned =
        align_profiles(scan.profile.s_m, scan.profile.height_m, first.s_m, first.height_m, common);
    if (out.with_first.empty()) {
      out.s_m = aligned.heights.s_m;
    } else if (std::isfinite(aligned.comparison.correlation)) {
      correlations.push_back(aligned.comparison.correlation);
    }
    out.with_first.push_back(aligned.comparison);
    out.height_m.push_back(on_points(out.s_m, aligned.heights, common.spacing_m));
    if (!scan.periodicity.periodic) continue;
    pitches_m.push_back(scan.periodicity.pitch_m);
    depths_m.push_back(scan.periodicity.depth_m);
  }
  out.pitch_m = mean_and_spread(pitches_m);
  out.depth_m = mean_and_spread(depths_m);
  out.correlation = mean_and_spread(correlations);
  measure_spread(out);
  return out;
}

}  // namespace asperity
