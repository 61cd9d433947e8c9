// A recording whose path is over the same line several times: the RMS error of its profile without and with its passes
// merged, and whether the merge was laid (docs/merge.md, "In one recording").
//
//   repeated_strokes [--surfaces sandpaper,clay_pot,sine,protoboard,cable_tie] [--strokes 5] [--length_m 0.04]
//                    [--repeats 3] [--seed 1] [--paths guide,free,near,rows] [--probe open]
//
// Paths: `guide`, all strokes on one line; `free`, the same by a hand that wanders by 0.1 mm RMS; `near`, rows 0.2 mm
// apart; `rows`, 2.5 mm apart.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_session.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

struct Choice {
  std::vector<std::string> surfaces{"sandpaper", "clay_pot", "sine", "protoboard", "cable_tie"};
  std::vector<std::string> paths{"guide", "free", "near", "rows"};
  int strokes = 5, repeats = 3;
  std::int64_t seed = 1;
  double length_m = 0.04;
  std::string probe = "open";
};

asperity::SimulationConfig config_of(const Choice& choice, const std::string& surface, const std::string& path,
                                     std::int64_t seed) {
  asperity::SimulationConfig config = asperity::make_simulation_config(surface, choice.probe);
  config.seed = seed;
  config.hand.path = asperity::HandPathShape::kBackAndForth;
  config.hand.strokes = choice.strokes;
  config.hand.length_m = choice.length_m;
  config.hand.row_spacing_m = path == "near" ? 0.2e-3 : path == "rows" ? 2.5e-3 : 0.0;
  if (path == "guide") config.hand.lateral_wander_m = 0.0;
  return config;
}

void run(const Choice& choice, const std::string& surface, const std::string& path, std::int64_t seed,
         std::vector<double>& ratios) {
  asperity::ProcessSession session(asperity::simulate_recording(config_of(choice, surface, path, seed)));
  asperity::ProcessConfig config;
  config.profile.merge_passes = false;
  const asperity::ProcessResult apart = session.process(config);
  config.profile.merge_passes = true;
  const asperity::ProcessResult& merged = session.process(config);
  std::printf("| %s | %s | %lld |", surface.c_str(), path.c_str(), static_cast<long long>(seed));
  if (!apart.accuracy || !apart.accuracy->profile) {
    std::printf(" no profile |\n");
    return;
  }
  const double before_um = apart.accuracy->profile->rms_um, after_um = merged.accuracy->profile->rms_um;
  std::printf(" %.2f | %.2f | %.2f | %.4f | %.4f | %.2f | %.2f |", before_um, after_um, after_um / before_um,
              apart.accuracy->profile->correlation, merged.accuracy->profile->correlation,
              1e6 * apart.noise.noise_rms_m, 1e6 * merged.noise.noise_rms_m);
  if (merged.lines.empty()) std::printf(" no line is shared | | |");
  for (const asperity::RepeatedLine& line : merged.lines) {
    std::printf(" %zu of %zu %s | %.2f | %.2f (%.2f to %.2f) |", line.merged.used, line.merged.passes.size(),
                line.laid ? "laid" : "not laid", line.merged.added_ratio, line.merged.noise_ratio,
                line.merged.noise_ratio_low, line.merged.noise_ratio_high);
    if (line.laid) ratios.push_back(after_um / before_um);
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Choice choice;
    bench::read_options(
        argc, argv,
        {{"--surfaces", [&](auto value) { choice.surfaces = bench::split_list(value); }},
         {"--paths", [&](auto value) { choice.paths = bench::split_list(value); }},
         {"--strokes", [&](auto value) { choice.strokes = static_cast<int>(bench::number_within(value, 2.0, 50.0)); }},
         {"--repeats", [&](auto value) { choice.repeats = static_cast<int>(bench::number_within(value, 1.0, 1e4)); }},
         {"--length_m", [&](auto value) { choice.length_m = bench::number_within(value, 0.02, 1.0); }},
         {"--seed",
          [&](auto value) { choice.seed = static_cast<std::int64_t>(bench::number_within(value, 1.0, 1e9)); }},
         {"--probe", [&](auto value) { choice.probe = std::string(value); }}});
    std::printf(
        "| surface | path | seed | apart, µm RMS error | merged, µm | ratio | correlation apart | merged | expected "
        "apart, µm | merged, µm | passes | differences over added noise, power | over all stated noise (95 %%) |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    std::vector<double> ratios;
    for (const std::string& path : choice.paths) {
      for (const std::string& surface : choice.surfaces) {
        for (int i = 0; i < choice.repeats; ++i) run(choice, surface, path, choice.seed + i, ratios);
      }
    }
    std::sort(ratios.begin(), ratios.end());
    if (!ratios.empty()) {
      std::printf("\nlaid: %zu; ratio of the errors: median %.2f, largest %.2f\n", ratios.size(),
                  ratios[ratios.size() / 2], ratios.back());
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "repeated_strokes: %s\n", error.what());
    return 1;
  }
}
