#include "asperity/verdict/judge_rendering.h"

#include <fmt/format.h>

#include <cmath>

#include "asperity/base/text.h"
#include "asperity/verdict/verdict_codes.h"

namespace asperity {

namespace {

std::string ticks(std::uint64_t count) { return fmt::format("{} tick{}", count, count == 1 ? "" : "s"); }

}  // namespace

Verdicts judge_run(const RunEvidence& evidence) {
  Verdicts out;
  const auto say = [&](const char* code, std::string message) {
    out.push_back(make_verdict(code, std::move(message)));
  };
  if (!evidence.device_fault.empty()) say("device_fault", "the device has a fault: " + evidence.device_fault);
  if (evidence.ticks_not_finite > 0) {
    say("force_not_finite", fmt::format("the force was ramped to zero: {} had numbers that are not finite",
                                        ticks(evidence.ticks_not_finite)));
  }
  if (evidence.ticks_stale > 0) {
    say("device_stale",
        fmt::format("the force was ramped to zero for {}: the device's positions came late or not at all",
                    ticks(evidence.ticks_stale)));
  }
  if (evidence.ticks_implausible > 0) {
    say("position_implausible",
        fmt::format("the force was ramped to zero: on {} no hand could be at the device's position",
                    ticks(evidence.ticks_implausible)));
  }
  if (evidence.ticks > 0 && evidence.ticks_touching == 0) {
    std::string message = "nothing was touched";
    if (std::isfinite(evidence.nearest_m)) {
      message += fmt::format(": the path comes no nearer to a surface than {:.4g} mm", 1e3 * evidence.nearest_m);
    }
    say("scene_not_touched", std::move(message));
  }
  if (evidence.ticks_force_limited > 0) {
    say("force_limited",
        fmt::format("{} were limited to {} N", ticks(evidence.ticks_force_limited), number_text(evidence.max_force_N)));
  }
  if (evidence.ticks_rate_limited > 0) {
    say("force_slowed", fmt::format("on {} the force changed faster than {} N/s and was slowed",
                                    ticks(evidence.ticks_rate_limited), number_text(evidence.max_force_rate_N_per_s)));
  }
  if (evidence.ticks_unlogged > 0) {
    say("log_incomplete", fmt::format("{} are missing in the log", ticks(evidence.ticks_unlogged)));
  }
  if (evidence.ticks_starting_inside > 0) {
    say("started_inside", fmt::format("the point started inside an object: no force for {}, until it had left it",
                                      ticks(evidence.ticks_starting_inside)));
  }
  sort_verdicts(out);
  return out;
}

Verdicts judge_rendering(const RenderingEvidence& evidence) {
  Verdicts out;
  // nan, where nothing was in contact, is not enough either.
  if (!(evidence.contact_fraction >= evidence.min_contact_fraction)) {
    out.push_back(
        make_verdict("scan_not_rendered",
                     std::isfinite(evidence.contact_fraction)
                         ? fmt::format("check of the renderer: only {:.0f} % of the scan's contact was rendered",
                                       100.0 * evidence.contact_fraction)
                         : "check of the renderer: nothing of the scan was in contact"));
  }
  if (!(evidence.score >= evidence.min_score)) {
    out.push_back(make_verdict(
        "rendering_poor",
        std::isfinite(evidence.score)
            ? fmt::format("check of the renderer: a score of {:.2f} is poor ({})", evidence.score, evidence.comparison)
            : "check of the renderer: nothing could be compared, so the check has no score"));
  }
  return out;
}

}  // namespace asperity
