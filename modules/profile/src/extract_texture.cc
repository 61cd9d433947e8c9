#include "asperity/profile/extract_texture.h"

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/signal/statistics.h"
#include "asperity/signal/zero_phase.h"
#include "gap_runs.h"

namespace asperity {

std::vector<double> extract_texture(std::span<const double> height_m, double spacing_m, double cutoff_cycles_per_mm,
                                    double bridge_m, std::span<const std::size_t> breaks) {
  if (!(spacing_m > 0.0) || !(cutoff_cycles_per_mm >= 0.0) || !(bridge_m >= 0.0)) {
    throw Error("texture: spacing " + number_text(spacing_m) + " m, cut-off " + number_text(cutoff_cycles_per_mm) +
                " cycles/mm, bridge " + number_text(bridge_m) + " m");
  }
  const double rate_per_mm = 1e-3 / spacing_m;
  const auto bridge = static_cast<std::size_t>(bridge_m / spacing_m + 0.5);
  return filter_runs(height_m, bridge, breaks, 8, [&](std::span<const double> run) {
    if (cutoff_cycles_per_mm > 0.0) return zero_phase_highpass(run, cutoff_cycles_per_mm, rate_per_mm);
    std::vector<double> level(run.begin(), run.end());
    const double middle = mean(run);
    for (double& h : level) h -= middle;
    return level;
  });
}

}  // namespace asperity
