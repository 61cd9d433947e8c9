// The tip's height and the eroded one beside the surface (docs/merge.md, "Tip").
//
//   tip_erosion [--surfaces sandpaper,clay_pot,cable_tie,protoboard] [--repeats 2] [--seed 1] [--imperfection 1]
//
// Straight strokes without wander, so that the surface under the path is known: z(s) in the comparison's band.

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/profile/compare_profiles.h"
#include "asperity/profile/erode_profile.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

void run(const std::string& name, std::int64_t seed, double imperfection) {
  asperity::SimulationConfig config = asperity::make_simulation_config(name, "open");
  config.seed = seed;
  config.hand.lateral_wander_m = 0.0;
  config.calibration.imperfection = imperfection;
  const auto surface = asperity::make_surface(config.surface, static_cast<std::uint64_t>(seed));
  const asperity::Recording recording = asperity::simulate_recording(config, *surface);
  asperity::ProcessConfig process;
  process.profile.tip.mode = asperity::TipMode::kErode;
  const asperity::ProcessResult result = asperity::process_recording(recording, process);
  std::vector<double> s_m, z_m;
  for (double s = 0.0; s < config.hand.length_m; s += 5e-6) {
    s_m.push_back(s);
    z_m.push_back(surface->height_m(s - 0.5 * config.hand.length_m, 0.0));
  }
  asperity::ComparisonConfig comparison;
  comparison.high_cycles_per_mm = result.accuracy->band_high_cycles_per_mm;
  const auto error_um = [&](const std::vector<double>& height_m) {
    return asperity::compare_profiles(result.profile.s_m, height_m, s_m, z_m, comparison).rms_um;
  };
  const asperity::ErodedProfile& eroded = *result.surface;
  std::printf("| %s %lld | %.1f | %.1f | %s | %.2f | %.1f | %.1f | %.2f |\n", name.c_str(),
              static_cast<long long>(seed), error_um(result.profile.height_m), error_um(eroded.surface_m),
              eroded.determined ? "yes" : "no", 1e6 * eroded.correction_rms_m, 1e6 * eroded.noise_rms_m,
              1e6 * eroded.bias_m, eroded.touched_share);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::vector<std::string> surfaces{"sandpaper", "clay_pot", "cable_tie", "protoboard"};
    int repeats = 2;
    std::int64_t seed = 1;
    double imperfection = 1.0;
    bench::read_options(
        argc, argv,
        {{"--surfaces", [&](auto value) { surfaces = bench::split_list(value); }},
         {"--repeats", [&](auto value) { repeats = static_cast<int>(bench::number_within(value, 1.0, 1e4)); }},
         {"--seed", [&](auto value) { seed = static_cast<std::int64_t>(bench::number_within(value, 1.0, 1e9)); }},
         {"--imperfection", [&](auto value) { imperfection = bench::number_within(value, 0.0, 10.0); }}});
    std::printf(
        "| surface, seed | tip's height from surface, µm RMS | eroded, µm | applied | correction, µm | noise of "
        "the erosion, µm | its mean, µm | touched |\n");
    std::printf("|---|---|---|---|---|---|---|---|\n");
    for (const std::string& surface : surfaces) {
      for (int i = 0; i < repeats; ++i) run(surface, seed + i, imperfection);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tip_erosion: %s\n", error.what());
    return 1;
  }
}
