// Where the gain of the measured texture comes from: scans of the accuracy bench (docs/accuracy.md), and the same with
// one error at a time replaced by the truth. Prints a table in Markdown, medians over the seeds.
//
//   gain_loss [--seeds 5] [--speed 25] [--probe open] [--surfaces sine,…] [--removed yes|no] [--bands yes] [--each yes]
//             [--set probe.quantise=false,…]
//
// With e = p − p_true, the error of a tip position at a sample, n the base's normal there: `true heights` has the
// positions p − (n·e) n, `true positions along the surface` p_true + (n·e) n, `true motion` p_true; the base path is
// found from each. Noise removed: `remove_noise`; without --removed both. Calibration: as the bench draws it, or exact.
// --bands: gain and correlation from 0.15 to 0.3, 0.6, 1.2, 2.4 and 4 cycles/mm. --each: the gain of each seed.
//
// r: correlation. r²: the gain of an estimate of least expected error. Power: RMS of the measured heights over that of
// the true ones; a wrong position along the path leaves it as it is and lowers r and the gain.

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/pipeline/process_motion.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/spectrum.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

using Eigen::Vector3d;

constexpr const char* kCaseNames[] = {"as processed", "true heights", "true positions along the surface",
                                      "true motion"};
constexpr std::size_t kCases = std::size(kCaseNames);
constexpr double kEdges_per_mm[] = {0.15, 0.3, 0.6, 1.2, 2.4, 4.0};
constexpr std::size_t kBands = std::size(kEdges_per_mm) - 1;

struct Options {
  int seeds = 5;
  double speed_mm_s = 25.0;
  std::string probe = "open";
  std::vector<std::string> surfaces{"sine", "protoboard", "cable_tie", "sandpaper", "clay_pot"};
  bool bands = false, each = false;
  std::vector<bool> removed{true, false};
  std::vector<std::string> settings;  // key=value, of the bench, after all others
};

Options parse_options(int argc, char** argv) {
  Options out;
  bench::read_options(argc, argv,
                      {{"--seeds", [&](auto value) { out.seeds = bench::seed_count(value); }},
                       {"--speed", [&](auto value) { out.speed_mm_s = bench::number_within(value, 1.0, 200.0); }},
                       {"--probe", [&](auto value) { out.probe = std::string(value); }},
                       {"--surfaces", [&](auto value) { out.surfaces = bench::split_list(value); }},
                       {"--removed", [&](auto value) { out.removed = {bench::is_first(value, "yes", "no")}; }},
                       {"--set", [&](auto value) { out.settings = bench::split_list(value); }},
                       {"--each", [&](auto value) { out.each = bench::is_first(value, "yes", "no"); }},
                       {"--bands", [&](auto value) { out.bands = bench::is_first(value, "yes", "no"); }}});
  return out;
}

struct Metrics {
  std::vector<double> correlation, gain, power, rms_um;
  std::vector<double> band_gain[kBands], band_correlation[kBands];
};

// Gain and correlation of the compared heights between two frequencies.
void add_bands(const asperity::ComparedHeights& heights, Metrics& out) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < heights.s_m.size(); ++i) {
    if (!std::isfinite(heights.true_m[i]) || !std::isfinite(heights.measured_m[i])) continue;
    x.push_back(heights.true_m[i]);
    y.push_back(heights.measured_m[i]);
  }
  if (x.size() < 64) return;
  const double length_mm = 1e3 * (heights.s_m[1] - heights.s_m[0]) * static_cast<double>(x.size());
  const auto a = asperity::real_dft(x), b = asperity::real_dft(y);
  for (std::size_t band = 0; band < kBands; ++band) {
    double xx = 0.0, yy = 0.0, xy = 0.0;
    for (std::size_t k = 1; k < a.size(); ++k) {
      const double frequency = static_cast<double>(k) / length_mm;
      if (frequency < kEdges_per_mm[band] || frequency >= kEdges_per_mm[band + 1]) continue;
      xx += std::norm(a[k]);
      yy += std::norm(b[k]);
      xy += (std::conj(a[k]) * b[k]).real();
    }
    if (!(xx > 0.0) || !(yy > 0.0)) continue;
    out.band_gain[band].push_back(xy / xx);
    out.band_correlation[band].push_back(xy / std::sqrt(xx * yy));
  }
}

void add(const asperity::ProcessResult& result, Metrics& out) {
  if (!result.accuracy || !result.accuracy->profile) return;
  const asperity::ProfileComparison& c = *result.accuracy->profile;
  out.correlation.push_back(c.correlation);
  out.gain.push_back(c.gain);
  out.power.push_back(c.gain / c.correlation);
  out.rms_um.push_back(c.rms_um);
  add_bands(result.accuracy->heights, out);
}

// The tip's true positions at the motion's times.
std::vector<Vector3d> true_positions(const asperity::TipMotion& motion, const asperity::Truth& truth) {
  const auto seconds = [&](const std::vector<std::int64_t>& t_ns) {
    std::vector<double> out;
    for (const std::int64_t t : t_ns) out.push_back(static_cast<double>(t - motion.t_ns[0]) * asperity::kNanosecond_s);
    return out;
  };
  const std::vector<double> at_s = seconds(motion.t_ns), true_s = seconds(truth.t_ns);
  std::vector<Vector3d> out(motion.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> x;
    for (const Vector3d& p : truth.p_world_tip_m) x.push_back(p[axis]);
    const std::vector<double> y = asperity::interpolate(true_s, x, at_s, 1e9);
    for (std::size_t i = 0; i < y.size(); ++i) out[i][axis] = y[i];
  }
  return out;
}

// The cases, with and without `remove_noise`.
void measure_cases(const asperity::Recording& recording, bool remove_noise, std::vector<Metrics>& out) {
  asperity::ProcessConfig process;
  process.profile.remove_noise = remove_noise;
  const asperity::ProcessResult result = asperity::process_recording(recording, process);
  add(result, out[0]);
  const asperity::TipMotion& motion = result.trajectory.motion;
  if (result.base.path.size() != motion.size()) return;
  const std::vector<Vector3d> p_true_m = true_positions(motion, *recording.truth);
  const auto with = [&](Metrics& metrics, bool normal_error, bool surface_error) {
    asperity::ProcessResult changed;
    changed.trajectory = result.trajectory;
    for (std::size_t i = 0; i < motion.size(); ++i) {
      const Vector3d error_m = motion.p_world_tip_m[i] - p_true_m[i];
      if (!error_m.allFinite()) continue;
      const Vector3d& normal = result.base.path.n_world[i];
      const Vector3d up_m = normal.dot(error_m) * normal;
      changed.trajectory.motion.p_world_tip_m[i] = p_true_m[i];
      if (normal_error) changed.trajectory.motion.p_world_tip_m[i] += up_m;
      if (surface_error) changed.trajectory.motion.p_world_tip_m[i] += error_m - up_m;
    }
    asperity::measure_along(
        recording, process,
        [&](const asperity::TipMotion& moved) {
          return asperity::find_base_path(moved, recording.calibration.tip_in_marker_m, process.base);
        },
        changed);
    add(changed, metrics);
  };
  with(out[1], false, true);
  with(out[2], true, false);
  with(out[3], false, false);
}

void print(const Metrics& m, const Options& options) {
  const double r = asperity::median(m.correlation);
  std::printf(" %.4f | %.4f | %.4f | %.4f | %.2f |", r, r * r, asperity::median(m.gain), asperity::median(m.power),
              asperity::median(m.rms_um));
  for (std::size_t band = 0; options.bands && band < kBands; ++band) {
    if (m.band_gain[band].empty()) continue;
    std::printf(" %.3f (%.3f)", asperity::median(m.band_gain[band]), asperity::median(m.band_correlation[band]));
  }
  if (options.each)
    for (const double gain : m.gain) std::printf(" %.4f", gain);
  std::printf(options.bands || options.each ? " |\n" : "\n");
}

void run(const Options& options) {
  std::printf("| surface | calibration | noise removed | case | r | r² | gain | power | RMS error, µm |%s\n",
              options.bands || options.each ? " by band: gain (r); by seed: gain |" : "");
  std::printf("|---|---|---|---|---|---|---|---|---|%s\n", options.bands || options.each ? "---|" : "");
  for (const std::string& surface : options.surfaces) {
    for (const bool exact : {false, true}) {
      for (const bool removed : options.removed) {
        std::vector<Metrics> cases(kCases);
        for (int seed = 1; seed <= options.seeds; ++seed) {
          asperity::SimulationConfig config = asperity::make_simulation_config(surface, options.probe);
          config.seed = seed;
          config.hand.speed_mps = 1e-3 * options.speed_mm_s;
          config.tracker.flip_chance = config.tracker.dropout_chance = 0.0;
          config.probe.spike_chance = config.probe.dropout_chance = 0.0;
          if (exact) config.calibration.imperfection = 0.0;
          measure_cases(asperity::simulate_recording(config), removed, cases);
        }
        for (std::size_t k = 0; k < kCases; ++k) {
          if (cases[k].gain.empty()) continue;
          std::printf("| %s | %s | %s | %s |", surface.c_str(), exact ? "exact" : "as drawn", removed ? "yes" : "no",
                      kCaseNames[k]);
          print(cases[k], options);
        }
      }
    }
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse_options(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "gain_loss: %s\n", error.what());
    return 1;
  }
}
