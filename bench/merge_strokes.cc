// Strokes over one line, merged: the RMS error of the merge over that of one stroke, and whether strokes over other
// lines and noise are refused (docs/merge.md).
//
//   merge_strokes [--surfaces sandpaper,clay_pot] [--strokes 5] [--repeats 3] [--seed 1] [--wander_m 0] [--probe open]
//                 [--lines same|other|none]
//
// The strokes have one relief and one path, as along a guide; hand, noise, probe and calibration are each stroke's own.
// With --wander_m each stroke has its own path, this far (RMS) about the line.

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/pipeline/merge_results.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/profile/compare_profiles.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

struct Choice {
  std::vector<std::string> surfaces{"sandpaper", "clay_pot"};
  int strokes = 5, repeats = 3;
  std::int64_t seed = 1;
  double wander_m = 0.0;
  std::string probe = "open", lines = "same";
};

asperity::SimulationConfig stroke_config(const Choice& choice, const std::string& surface, std::int64_t line, int k) {
  asperity::SimulationConfig config = asperity::make_simulation_config(surface, choice.probe);
  config.seed = 1000 * line + k + 1;
  config.surface.seed = choice.lines == "same" ? line : config.seed;
  if (choice.lines == "none") config.surface.rq_m = 0.0;
  config.hand.path_seed = line;
  if (choice.wander_m > 0.0) {
    config.hand.path_seed = config.seed;
    config.hand.lateral_wander_m = choice.wander_m;
  }
  return config;
}

// The RMS of heights from a stroke's truth, in the band in which that stroke was compared.
double error_um(const asperity::Profile& profile, const asperity::Truth& truth, const asperity::Accuracy& accuracy) {
  asperity::ComparisonConfig comparison;
  comparison.high_cycles_per_mm = accuracy.band_high_cycles_per_mm;
  return asperity::compare_profiles(profile.s_m, profile.height_m, truth.s_m, truth.height_m, comparison).rms_um;
}

void run(const Choice& choice, const std::string& surface, std::int64_t line) {
  asperity::MergeConfig config;
  std::vector<asperity::MergeStroke> strokes;
  std::vector<asperity::Truth> truths;
  std::vector<asperity::Accuracy> accuracies;
  std::vector<double> single_um, stated_um;
  for (int k = 0; k < choice.strokes; ++k) {
    const asperity::Recording recording = asperity::simulate_recording(stroke_config(choice, surface, line, k));
    const asperity::ProcessResult removed = asperity::process_recording(recording, config.process);
    asperity::ProcessConfig as_measured = config.process;
    as_measured.profile.remove_noise = false;
    strokes.push_back(asperity::stroke_of_result(asperity::process_recording(recording, as_measured), recording,
                                                 std::to_string(k + 1)));
    truths.push_back(*recording.truth);
    accuracies.push_back(*removed.accuracy);
    if (removed.accuracy->profile) single_um.push_back(removed.accuracy->profile->rms_um);
    stated_um.push_back(1e6 * removed.noise.noise_rms_m);
  }
  const asperity::ProcessResult merged = asperity::merge_results(strokes, surface, config);
  std::printf("| %s %lld | %zu of %d |", surface.c_str(), static_cast<long long>(line), merged.passes->used,
              choice.strokes);
  if (!merged.passes->agrees) {
    std::printf(" refused | | | | | | |\n");
    return;
  }
  std::vector<double> merged_um, coherence;
  for (int k = 0; k < choice.strokes; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!merged.passes->passes[i].used) continue;
    merged_um.push_back(error_um(merged.profile, truths[i], accuracies[i]));
    coherence.push_back(merged.passes->passes[i].coherence);
  }
  const double one = asperity::median(single_um), all = asperity::median(merged_um);
  std::printf(" %.2f | %.2f | %.2f | %.2f | %.2f | %.2f (%.2f to %.2f) | %.4f |\n", one, all, all / one,
              asperity::median(stated_um), 1e6 * merged.noise.noise_rms_m, merged.passes->noise_ratio,
              merged.passes->noise_ratio_low, merged.passes->noise_ratio_high, asperity::median(coherence));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Choice choice;
    bench::read_options(argc, argv,
                        {{"--surfaces", bench::list_into(choice.surfaces)},
                         {"--strokes", bench::whole_into(choice.strokes, 2.0, 50.0)},
                         {"--repeats", bench::whole_into(choice.repeats, 1.0, 1e4)},
                         {"--seed", bench::whole_into(choice.seed, 1.0, 1e9)},
                         {"--wander_m", bench::number_into(choice.wander_m, 0.0, 0.01)},
                         {"--probe", bench::text_into(choice.probe)},
                         {"--lines", bench::text_into(choice.lines)}});
    std::printf(
        "| surface, seed | merged | one stroke, µm RMS error | merge, µm | ratio | one, expected µm | merge, "
        "expected µm | differences over stated noise, power (95 %%) | coherence |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& surface : choice.surfaces) {
      for (int i = 0; i < choice.repeats; ++i) run(choice, surface, choice.seed + i);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "merge_strokes: %s\n", error.what());
    return 1;
  }
}
