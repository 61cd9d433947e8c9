#include "scan/refine_scan.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/profile/compare_profiles.h"
#include "asperity/verdict/verdict_json.h"

namespace asperity::studio {

namespace {

// The causal profile against the refined one, where both can be compared.
Json difference_json(const LiveHeights& live, const ProcessResult& result, double rate_Hz, ComparisonConfig config) {
  try {
    config.high_cycles_per_mm =
        std::min(config.high_cycles_per_mm, comparison_limit_cycles_per_mm(rate_Hz, result.speed.mean_mps));
    const ProfileComparison found =
        compare_profiles(live.s_m, live.height_m, result.profile.s_m, result.profile.height_m, config);
    Json out;
    out["correlation"] = number_or_null(found.correlation);
    out["rms_um"] = number_or_null(found.rms_um);
    out["gain"] = number_or_null(found.gain);
    out["shift_m"] = number_or_null(found.shift_m);
    out["compared_m"] = number_or_null(found.compared_m);
    return out;
  } catch (const Error&) {
    return nullptr;  // too short
  }
}

}  // namespace

ScanRefiner::ScanRefiner(FinishedScan scan)
    : recording_(std::move(scan.recording)),
      segment_(std::move(scan.segment.name)),
      live_(std::move(scan.live)),
      session_(std::move(scan.rows)) {}

BlockWriter ScanRefiner::refine(const ProcessConfig& config, const Observer& observer) {
  const auto start = std::chrono::steady_clock::now();
  const ProcessResult& result = session_.process(config, observer);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  if (!std::exchange(only_live_, false)) took_s_ = took.count();
  const Profile& profile = result.profile;
  BlockWriter out("scan.refined");
  Json& head = out.head();
  head["recording"] = recording_;
  head["segment"] = printable(segment_, 100);
  head["took_s"] = took_s_;
  head["trustworthy"] = result.trustworthy;
  head["verdict"] = printable(result.verdict, 500);
  head["verdicts"] = verdicts_json(result.verdicts);
  head["length_m"] = result.coverage.length_m;
  head["covered"] = result.coverage.covered;
  head["speed_mps"] = result.speed.mean_mps;
  head["roughness"] = nullptr;
  if (result.roughness) {
    head["roughness"] = {{"Ra_m", number_or_null(result.roughness->Ra_m)},
                         {"Rq_m", number_or_null(result.roughness->Rq_m)}};
  }
  head["difference"] = difference_json(live_, result, session_.recording().info.probe_rate_Hz, config.comparison);
  out.add("s_m", std::span<const double>(profile.s_m));
  out.add("height_m", std::span<const double>(profile.height_m));
  out.add("sigma_m", std::span<const double>(profile.sigma_m));
  out.add("texture_m", std::span<const double>(profile.texture_m));
  out.add("force_N", std::span<const double>(profile.force_N));
  out.add("speed_mps", std::span<const double>(profile.speed_mps));
  return out;
}

}  // namespace asperity::studio
