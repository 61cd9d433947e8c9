#include "result_summary.h"

#include <fmt/format.h>

#include <cmath>

namespace asperity::app {

std::string result_summary(const ProcessResult& result) {
  const auto shape = kPathShapeNames.at(static_cast<std::size_t>(result.base.shape));
  std::string out =
      fmt::format("  scan path   {:.2f} mm on a {}, {:.0f} % with heights, {:.1f} mm/s\n",
                  result.coverage.length_m * 1e3, shape, 100.0 * result.coverage.covered, result.speed.mean_mps * 1e3);
  if (result.roughness) {
    const RoughnessResult& r = *result.roughness;
    out += fmt::format("  roughness   Ra {:.1f} µm, Rq {:.1f} µm, Rz {:.1f} µm, RSm {:.3f} mm\n", r.Ra_m * 1e6,
                       r.Rq_m * 1e6, r.Rz_m * 1e6, r.RSm_m * 1e3);
  }
  if (result.periodicity.periodic) {
    const Periodicity& p = result.periodicity;
    out += fmt::format("  pattern     pitch {:.3f} ± {:.3f} mm, depth {:.0f} ± {:.0f} µm over {} periods\n",
                       p.pitch_m * 1e3, p.pitch_stderr_m * 1e3, p.depth_m * 1e6, p.depth_stderr_m * 1e6, p.periods);
  }
  if (!result.stiffness.verdict.empty()) out += "  stiffness   " + result.stiffness.verdict + "\n";
  if (std::isfinite(result.compliance.k_c)) {
    out += fmt::format("  compliance  k_c {:.3f} over {} windows\n", result.compliance.k_c,
                       result.compliance.windows.size());
  }
  if (result.fit) {
    out += fmt::format("  texture     {:.4g} mm, {} harmonics, {:.1f} µm RMS, model error {:.1f} µm\n",
                       result.fit->texture.length_mm, result.fit->texture.a_m.size(), result.fit->rms_height_m * 1e6,
                       result.fit->rms_error_m * 1e6);
  }
  if (result.accuracy) {
    const Accuracy& a = *result.accuracy;
    out += fmt::format("  truth       position {:.0f} µm RMS (raw tracker {:.0f} µm)", a.position_rms_m * 1e6,
                       a.tracker_rms_m * 1e6);
    if (a.profile) {
      out += fmt::format(", profile: correlation {:.3f}, gain {:.3f}, {:.1f} µm RMS, length {:+.2f} %",
                         a.profile->correlation, a.profile->gain, a.profile->rms_um, a.profile->length_error_percent);
    }
    out += "\n";
  }
  for (const Problem& problem : result.problems) out += "  note        " + problem.message + "\n";
  return out;
}

}  // namespace asperity::app
