// The noise that a texture is said to have (docs/texture-noise.md) against its true error on the virtual bench, in the
// band of docs/profile.md (0.15 to min(4, 0.4·rate/speed) cycles/mm). One row a scan, then quantiles of the ratio.
//
//   texture_noise [--seeds N] [--first N] [--speeds 20,25,45] [--probes open,what] [--surfaces …] [--materials stiff]
//                 [--method fused] [--imperfection 1] [--spectrum yes|no]   yes: error and expectation by octaves
//                 [--table yes|no]   yes: the scans alone, in Markdown

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/true_profile.h"
#include "asperity/profile/estimate_texture_noise.h"
#include "asperity/profile/measure_spectrum.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

using asperity::Error;

struct Options {
  int seeds = 3, first = 1;
  double imperfection = 1.0;
  bool spectrum = false, table = false;
  std::string method = "fused";
  std::vector<std::string> surfaces{"sine", "protoboard", "cable_tie", "sandpaper", "clay_pot"};
  std::vector<std::string> probes{"open", "what"};
  std::vector<std::string> speeds{"20", "25", "45"};
  std::vector<std::string> materials{"stiff"};
};

Options parse_options(int argc, char** argv) {
  Options out;
  bench::read_options(
      argc, argv,
      {{"--seeds", [&](auto value) { out.seeds = bench::seed_count(value); }},
       {"--first", [&](auto value) { out.first = static_cast<int>(bench::number_within(value, 0, 1e9)); }},
       {"--imperfection", [&](auto value) { out.imperfection = bench::number_within(value, 0, 100); }},
       {"--spectrum", [&](auto value) { out.spectrum = bench::is_first(value, "yes", "no"); }},
       {"--table", [&](auto value) { out.table = bench::is_first(value, "yes", "no"); }},
       {"--method", [&](auto value) { out.method = value; }},
       {"--surfaces", [&](auto value) { out.surfaces = bench::split_list(value); }},
       {"--probes", [&](auto value) { out.probes = bench::split_list(value); }},
       {"--materials", [&](auto value) { out.materials = bench::split_list(value); }},
       {"--speeds", [&](auto value) { out.speeds = bench::split_list(value); }}});
  return out;
}

// Power of the band-pass of compare_profiles.h.
double band_gain(double k, double low, double high) {
  const double rise = 1.0 / (1.0 + (std::numbers::sqrt2 - 1.0) * std::pow(low / k, 4));
  const double fall = 1.0 / (1.0 + (std::numbers::sqrt2 - 1.0) * std::pow(k / high, 4));
  return rise * rise * fall * fall;
}

// The expected error's power between two frequencies, µm², as the comparison's band-pass leaves it.
double expected_um2(const asperity::ProcessResult& result, double band_high, double from, double to) {
  constexpr double kBandLow = 0.15;
  const auto& k = result.noise.frequency_cycles_per_mm;
  const double cutoff = result.config.profile.cutoff_cycles_per_mm;
  double sum = 0.0;
  for (std::size_t i = 1; i < k.size(); ++i) {
    const double at = std::sqrt(k[i] * k[i - 1]);
    if (at < from || at >= to) continue;
    const double gain = band_gain(at, kBandLow, band_high) / asperity::texture_power_gain(at, cutoff);
    const auto density = [&](std::size_t j) {
      return result.noise.added_psd_m2_mm[j] + result.noise.misplaced_psd_m2_mm[j];
    };
    sum += 0.5 * (density(i) + density(i - 1)) * gain * (k[i] - k[i - 1]);
  }
  return 1e12 * sum;
}

void print_octaves(const asperity::ProcessResult& result) {
  const auto& heights = result.accuracy->heights;
  const double spacing_m = heights.s_m[1] - heights.s_m[0];
  std::vector<double> error_m(heights.s_m.size());
  for (std::size_t i = 0; i < error_m.size(); ++i) error_m[i] = heights.measured_m[i] - heights.true_m[i];
  asperity::SpectrumConfig config;
  config.segment_m = 20e-3;
  const auto error = asperity::measure_spectrum(error_m, spacing_m, config);
  const auto truth = asperity::measure_spectrum(heights.true_m, spacing_m, config);
  if (error.frequency.size() < 2) return;
  const double step = error.frequency[1] - error.frequency[0];
  std::printf("    octave from, cycles/mm: true / error / expected rms, um:");
  for (double from = 0.125; from < 8.0; from *= 2.0) {
    double e = 0.0, t = 0.0;
    for (std::size_t i = 1; i < error.frequency.size(); ++i) {
      if (error.frequency[i] < from || error.frequency[i] >= 2.0 * from) continue;
      e += 1e12 * step * error.density[i];
      t += 1e12 * step * truth.density[i];
    }
    std::printf("  %.3g: %.1f/%.1f/%.1f", from, std::sqrt(t), std::sqrt(e),
                std::sqrt(expected_um2(result, result.accuracy->band_high_cycles_per_mm, from, 2.0 * from)));
  }
  std::printf("\n");
}

// The true texture over the measured stretch: the same filter, and gaps where the measured one has them.
std::vector<double> true_texture_m(const asperity::Recording& recording, const asperity::ProcessResult& result) {
  const asperity::Profile truth = asperity::true_profile(*recording.truth, result.config.profile);
  const asperity::Profile& measured = result.profile;
  std::vector<double> out(measured.size(), asperity::kNan);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double s_m = measured.s_m[i] + result.accuracy->profile->shift_m;
    const double place = (s_m - truth.s_m.front()) / truth.spacing_m;
    if (!std::isfinite(measured.texture_m[i]) || place < 0.0 || place + 1.0 >= static_cast<double>(truth.size()))
      continue;
    out[i] = truth.texture_m[static_cast<std::size_t>(std::lround(place))];
  }
  return out;
}

// Errors over standard errors, by figure.
using Scores = std::map<std::string, std::vector<double>>;

void score(const std::string& name, double value, double sigma, double truth, Scores& scores) {
  if (!std::isfinite(value) || !std::isfinite(sigma) || !std::isfinite(truth)) return;
  scores[name].push_back((value - truth) / sigma);
}

void print_scores(const Scores& scores) {
  for (const auto& [name, z] : scores) {
    std::size_t held = 0;
    for (const double one : z) held += std::abs(one) <= 1.96 ? 1 : 0;
    std::printf("  %-8s %3zu determined, 95 %% interval holds %3.0f %%, error over sigma: RMS %.2f, median %+.2f\n",
                name.c_str(), z.size(), 100.0 * static_cast<double>(held) / static_cast<double>(z.size()),
                asperity::rms(z), asperity::median(z));
  }
}

struct Tally {
  Scores scores;
  std::vector<double> ratio;
  int wild = 0;
};

void run_one(const Options& options, const asperity::SimulationConfig& config, const std::string& row, Tally& tally) {
  asperity::ProcessConfig process;
  asperity::set_field(asperity::list_fields("", process), "method", options.method);
  process.profile.remove_noise = false;  // error and expectation are both of the texture as measured
  const asperity::Recording recording = asperity::simulate_recording(config);
  const asperity::ProcessResult result = asperity::process_recording(recording, process);
  if (!result.accuracy || !result.accuracy->profile || !(result.accuracy->profile->rms_um > 0.0)) {
    std::printf("%s: no profile\n", row.c_str());
    return;
  }
  const auto& p = *result.accuracy->profile;
  const double expected_um = std::sqrt(expected_um2(result, result.accuracy->band_high_cycles_per_mm, 0.0, 1e9));
  const double ratio = expected_um / p.rms_um;
  const auto likely = [](double snr) { return std::sqrt(snr / (1.0 + snr)); };
  if (options.table) {
    std::printf("| %s | %.3f | %.3f | %.3f | %.1f | %.1f | %.1f | %.2f | %+.2f ± %.2f |\n", row.c_str(), p.correlation,
                likely(result.noise.snr), likely(result.noise.snr_low), p.true_rms_um, p.rms_um, expected_um, ratio,
                p.length_error_percent, 100.0 * result.noise.length_stderr_m / result.coverage.length_m);
    return;
  }
  std::printf(
      "%-32s r %.3f (stated %.3f, at least %.3f) gain %.3f true %6.1f error %6.1f expected %6.1f um, ratio %.2f | "
      "noise %.1f±%.1f texture %.1f at most %.1f um, position %.0f um, length %+.2f ± %.2f %%%s\n",
      row.c_str(), p.correlation, likely(result.noise.snr), likely(result.noise.snr_low), p.gain, p.true_rms_um,
      p.rms_um, expected_um, ratio, 1e6 * result.noise.noise_rms_m, 1e6 * result.noise.noise_rms_stderr_m,
      1e6 * result.noise.texture_rms_m, 1e6 * result.noise.at_most_m, 1e6 * result.noise.place_sigma_m,
      p.length_error_percent, 100.0 * result.noise.length_stderr_m / result.coverage.length_m,
      result.trustworthy ? "" : " (invalid)");
  if (options.spectrum) print_octaves(result);
  if (result.roughness) {
    const asperity::RoughnessResult truth =
        asperity::measure_roughness(true_texture_m(recording, result), result.profile.spacing_m, process.roughness);
    const asperity::RoughnessResult& r = *result.roughness;
    for (const asperity::RoughnessParameter& one : asperity::kRoughnessParameters) {
      score(std::string(one.name), r.*one.value, r.standard_error.*one.value, truth.*one.value, tally.scores);
    }
    if (options.spectrum) {
      for (const asperity::RoughnessParameter& one : asperity::kRoughnessParameters) {
        const double unit = one.is_length ? 1e6 : 1.0;
        std::printf("    %s %.4g ± %.2g, truth %.4g\n", std::string(one.name).c_str(), unit * (r.*one.value),
                    unit * (r.standard_error.*one.value), unit * (truth.*one.value));
      }
    }
  }
  score("length", p.length_error_percent, 100.0 * result.noise.length_stderr_m / result.coverage.length_m, 0.0,
        tally.scores);
  tally.ratio.push_back(ratio);
  tally.wild += ratio < 1.0 / 1.5 || ratio > 1.5 ? 1 : 0;
}

void run(const Options& options) {
  if (options.table) {
    std::printf(
        "| scan: probe, surface, material, mm/s, seed | r | r by the SNR | at least | true, µm | error, µm | expected, "
        "µm "
        "| expected / error | length error, %% |\n|---|---|---|---|---|---|---|---|---|\n");
  }
  for (const auto& probe : options.probes) {
    Tally tally;
    for (const auto& speed : options.speeds) {
      for (const auto& surface : options.surfaces) {
        for (const auto& material : options.materials) {
          for (int seed = options.first; seed < options.first + options.seeds; ++seed) {
            asperity::SimulationConfig config = asperity::make_simulation_config(surface, probe, material);
            config.seed = seed;
            config.hand.speed_mps = 1e-3 * bench::number_within(speed, 1, 1000);
            config.calibration.imperfection = options.imperfection;
            run_one(options, config, probe + " " + surface + " " + material + " " + speed + " " + std::to_string(seed),
                    tally);
            std::fflush(stdout);
          }
        }
      }
    }
    if (tally.ratio.empty()) continue;
    print_scores(tally.scores);
    std::printf(
        "%s: expected over true error: 10 %% %.2f, median %.2f, 90 %% %.2f; outside a factor of 1.5: %d of %zu\n",
        probe.c_str(), asperity::percentile(tally.ratio, 10), asperity::median(tally.ratio),
        asperity::percentile(tally.ratio, 90), tally.wild, tally.ratio.size());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse_options(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "texture_noise: %s\n", error.what());
    return 1;
  }
}
