// Chooses the high-pass of texture_m by measurement: for each cut-off the RMS difference between texture_m and
// the true heights less their mean, over the length that has heights. What the filter takes from the true
// texture and what slow errors it leaves both count. Prints medians over surfaces and seeds, in µm.
//
//   cutoff [SEEDS]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/profile/extract_texture.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"

namespace {

constexpr double kCutoffs_cycles_per_mm[] = {0.0, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4};

// The truth's height over its furthest s so far: resampling wants s that does not fall.
std::vector<double> true_heights(const asperity::Truth& truth, const std::vector<double>& at_m) {
  std::vector<double> s_m;
  std::vector<double> height_m;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!s_m.empty() && truth.s_m[i] <= s_m.back()) continue;
    s_m.push_back(truth.s_m[i]);
    height_m.push_back(truth.height_m[i]);
  }
  return asperity::interpolate(s_m, height_m, at_m);
}

double rms_difference_um(const std::vector<double>& measured_m, const std::vector<double>& true_m) {
  std::vector<double> difference_m;
  for (std::size_t i = 0; i < measured_m.size(); ++i) {
    const double d = measured_m[i] - true_m[i];
    if (std::isfinite(d)) difference_m.push_back(d);
  }
  return 1e6 * std::sqrt(asperity::variance(difference_m));
}

void run(int seeds) {
  std::printf("| probe | surface | true RMS, µm |");
  for (const double cutoff : kCutoffs_cycles_per_mm) std::printf(" %g |", cutoff);
  std::printf("\n|---|---|---|");
  for ([[maybe_unused]] const double cutoff : kCutoffs_cycles_per_mm) std::printf("---|");
  std::printf("\n");
  for (const char* probe : {"open", "what"}) {
    for (const char* surface : {"sine", "protoboard", "cable_tie", "sandpaper", "clay_pot"}) {
      std::vector<std::vector<double>> errors_um(std::size(kCutoffs_cycles_per_mm));
      std::vector<double> true_um;
      for (int seed = 1; seed <= seeds; ++seed) {
        asperity::SimulationConfig config = asperity::make_simulation_config(surface, probe);
        config.seed = seed;
        const asperity::Recording recording = asperity::simulate_recording(config);
        const asperity::ProcessConfig process;
        const asperity::ProcessResult result = asperity::process_recording(recording, process);
        std::vector<double> at_m = result.profile.s_m;
        for (double& s : at_m) s += result.accuracy->profile->shift_m;
        const std::vector<double> true_m = true_heights(*recording.truth, at_m);
        const std::vector<double> none_m(true_m.size(), 0.0);
        true_um.push_back(rms_difference_um(none_m, true_m));
        for (std::size_t c = 0; c < errors_um.size(); ++c) {
          const std::vector<double> texture_m = asperity::extract_texture(
              result.profile.height_m, result.profile.spacing_m, kCutoffs_cycles_per_mm[c], process.profile.bridge_m);
          errors_um[c].push_back(rms_difference_um(texture_m, true_m));
        }
      }
      std::printf("| %s | %s | %.0f |", probe, surface, asperity::median(true_um));
      for (const auto& errors : errors_um) std::printf(" %.1f |", asperity::median(errors));
      std::printf("\n");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto seeds = argc > 1 ? asperity::parse_int64(argv[1]) : 3;
    if (!seeds || *seeds < 1 || *seeds > 1000) throw asperity::Error("cutoff: seeds must be from 1 to 1000");
    run(static_cast<int>(*seeds));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
