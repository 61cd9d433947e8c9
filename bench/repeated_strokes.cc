// A recording whose path is over the same line several times: the RMS error of its passes without and with the merge,
// medians over them, and whether the merge was laid (docs/merge-lines.md).
//
//   repeated_strokes [--surfaces sandpaper,clay_pot,sine,protoboard,cable_tie] [--strokes 5] [--length_m 0.04]
//                    [--repeats 3] [--seed 1] [--paths guide,free,near,rows,mesh] [--probe open]
//
// Paths: `guide`, all strokes on one line; `free`, the same by a hand that wanders by 0.1 mm RMS; `near`, rows 0.2 mm
// apart; `rows`, 2.5 mm apart; `mesh`, as many scans along one line over the bench's pebble, registered together from
// 1 mm and 1 degree off: medians over the scans.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_session.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/pipeline/true_pose.h"
#include "asperity/profile/compare_profiles.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/make_pebble.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/random_motion.h"
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

void print_lines(const std::vector<asperity::RepeatedLine>& lines, const std::vector<double>& ratios,
                 std::vector<double>& laid_ratios) {
  if (lines.empty()) std::printf(" no line is shared | | |");
  bool laid = false;
  for (const asperity::RepeatedLine& line : lines) {
    std::printf(" %zu of %zu %s | %.2f, %.2f, %.2f | %.2f (%.2f to %.2f) |", line.merged.used,
                line.merged.passes.size(), line.laid ? "merged" : "not merged", line.merged.lines_over_noise,
                line.merged.noise_scale, 1e3 * line.merged.apart_m, line.merged.noise_ratio,
                line.merged.noise_ratio_low, line.merged.noise_ratio_high);
    laid |= line.laid;
  }
  if (laid) laid_ratios.insert(laid_ratios.end(), ratios.begin(), ratios.end());
  std::printf("\n");
  std::fflush(stdout);
}

// RMS error of a part of a profile, by its own shift: after a turn the arc length is off by more than a stroke's.
double part_error_um(const asperity::Profile& profile, const asperity::RepeatedLine::Span& span,
                     const asperity::Truth& truth, double high_cycles_per_mm) {
  constexpr double kBeyond_m = 6e-3;
  std::vector<double> s_m, height_m, true_s_m, true_height_m;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (profile.s_m[i] < span.from_m || profile.s_m[i] > span.to_m) continue;
    s_m.push_back(profile.s_m[i]);
    height_m.push_back(profile.height_m[i]);
  }
  for (std::size_t i = 0; i < truth.s_m.size(); ++i) {
    if (truth.s_m[i] < span.from_m - kBeyond_m || truth.s_m[i] > span.to_m + kBeyond_m) continue;
    true_s_m.push_back(truth.s_m[i]);
    true_height_m.push_back(truth.height_m[i]);
  }
  asperity::ComparisonConfig comparison;
  comparison.high_cycles_per_mm = high_cycles_per_mm;
  comparison.max_shift_m = 4e-3;
  return asperity::compare_profiles(s_m, height_m, true_s_m, true_height_m, comparison).rms_um;
}

void run(const Choice& choice, const std::string& surface, const std::string& path, std::int64_t seed,
         std::vector<double>& ratios) {
  const asperity::Recording recording = asperity::simulate_recording(config_of(choice, surface, path, seed));
  asperity::ProcessSession session(recording);
  asperity::ProcessConfig config;
  config.profile.merge_passes = false;
  const asperity::ProcessResult apart = session.process(config);
  config.profile.merge_passes = true;
  const asperity::ProcessResult& merged = session.process(config);
  std::printf("| %s | %s | %lld |", surface.c_str(), path.c_str(), static_cast<long long>(seed));
  std::vector<double> before_um, after_um, ratio;
  for (const asperity::RepeatedLine& line : merged.lines) {
    for (std::size_t k = 0; k < line.spans.size(); ++k) {
      if (!line.merged.passes[k].used) continue;
      const double high = merged.accuracy->band_high_cycles_per_mm;
      before_um.push_back(part_error_um(apart.profile, line.spans[k], *recording.truth, high));
      after_um.push_back(part_error_um(merged.profile, line.spans[k], *recording.truth, high));
      ratio.push_back(after_um.back() / before_um.back());
    }
  }
  if (ratio.empty()) {
    std::printf(" | | | | | | | no pass is used%s | | |\n", merged.lines.empty() ? ": no line is shared" : "");
    return;
  }
  std::printf(" %.2f | %.2f | %.2f, largest %.2f | | | %.2f | %.2f |", asperity::median(before_um),
              asperity::median(after_um), asperity::median(ratio), *std::max_element(ratio.begin(), ratio.end()),
              1e6 * apart.noise.noise_rms_m, 1e6 * merged.noise.noise_rms_m);
  print_lines(merged.lines, ratio, ratios);
}

asperity::Scan scan_on_mesh(const Choice& choice, const std::string& surface, std::int64_t seed, int k,
                            const asperity::TriangleMesh& mesh) {
  asperity::SimulationConfig config = asperity::make_simulation_config(surface, choice.probe);
  config.seed = 1000 * seed + k + 1;
  config.surface.seed = seed;
  config.hand.path_seed = seed;
  config.hand.length_m = choice.length_m;
  config.shape.kind = asperity::BaseShapeKind::kMesh;
  asperity::Scan out;
  out.name = "scan" + std::to_string(k + 1);
  out.recording = asperity::simulate_recording(
      config, *asperity::make_surface(config.surface, static_cast<std::uint64_t>(seed)), mesh);
  return out;
}

void run_mesh(const Choice& choice, const std::string& surface, std::int64_t seed, std::vector<double>& ratios) {
  asperity::PebbleConfig pebble;
  pebble.seed = static_cast<int>(seed);
  const asperity::TriangleMesh mesh = asperity::make_pebble(pebble);
  std::vector<asperity::Scan> scans;
  for (int k = 0; k < choice.strokes; ++k) scans.push_back(scan_on_mesh(choice, surface, seed, k, mesh));
  const asperity::Pose truth = asperity::true_pose(*scans.front().recording).value();
  const asperity::Pose guess = asperity::random_motion(1e-3, 0.0175, truth * Eigen::Vector3d(0.0, 0.06, 0.35),
                                                       static_cast<std::uint64_t>(seed)) *
                               truth;
  asperity::RegisterConfig config;
  config.process.profile.merge_passes = false;
  const asperity::ScansOnMesh apart = asperity::register_scans(scans, mesh, guess, config);
  config.process.profile.merge_passes = true;
  const asperity::ScansOnMesh merged = asperity::register_scans(scans, mesh, guess, config);
  std::vector<double> before_um, after_um, ratio, before_correlation, after_correlation, before_sigma, after_sigma;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    const asperity::ProcessResult &one = apart.scans[k].process, &other = merged.scans[k].process;
    if (!one.accuracy || !one.accuracy->profile || !other.accuracy || !other.accuracy->profile) continue;
    before_um.push_back(one.accuracy->profile->rms_um);
    after_um.push_back(other.accuracy->profile->rms_um);
    ratio.push_back(after_um.back() / before_um.back());
    before_correlation.push_back(one.accuracy->profile->correlation);
    after_correlation.push_back(other.accuracy->profile->correlation);
    before_sigma.push_back(1e6 * one.noise.noise_rms_m);
    after_sigma.push_back(1e6 * other.noise.noise_rms_m);
  }
  std::printf("| %s | mesh | %lld |", surface.c_str(), static_cast<long long>(seed));
  if (ratio.empty()) {
    std::printf(" no profile |\n");
    return;
  }
  std::printf(" %.2f | %.2f | %.2f, largest %.2f | %.4f | %.4f | %.2f | %.2f |", asperity::median(before_um),
              asperity::median(after_um), asperity::median(ratio), *std::max_element(ratio.begin(), ratio.end()),
              asperity::median(before_correlation), asperity::median(after_correlation), asperity::median(before_sigma),
              asperity::median(after_sigma));
  print_lines(merged.lines, ratio, ratios);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Choice choice;
    bench::read_options(argc, argv,
                        {{"--surfaces", bench::list_into(choice.surfaces)},
                         {"--paths", bench::list_into(choice.paths)},
                         {"--strokes", bench::whole_into(choice.strokes, 2.0, 50.0)},
                         {"--repeats", bench::whole_into(choice.repeats, 1.0, 1e4)},
                         {"--length_m", bench::number_into(choice.length_m, 0.02, 1.0)},
                         {"--seed", bench::whole_into(choice.seed, 1.0, 1e9)},
                         {"--probe", bench::text_into(choice.probe)}});
    std::printf(
        "| surface | path | seed | separate, µm RMS error | merged, µm | ratio | correlation, separate | merged | "
        "expected "
        "separate, µm | merged, µm | passes | lines over noise (power), noise scale, mm apart | over all stated noise "
        "(95 "
        "%%) |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    std::vector<double> ratios;
    for (const std::string& path : choice.paths) {
      for (const std::string& surface : choice.surfaces) {
        for (int i = 0; i < choice.repeats; ++i) {
          if (path == "mesh") {
            run_mesh(choice, surface, choice.seed + i, ratios);
          } else {
            run(choice, surface, path, choice.seed + i, ratios);
          }
        }
      }
    }
    std::sort(ratios.begin(), ratios.end());
    if (!ratios.empty()) {
      std::printf("\nmerged lines: %zu; ratio of the errors: median %.2f, largest %.2f\n", ratios.size(),
                  ratios[ratios.size() / 2], ratios.back());
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "repeated_strokes: %s\n", error.what());
    return 1;
  }
}
