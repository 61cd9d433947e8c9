// The tip's height and the eroded one beside the surface, and the bound of the tip's radius that the heights give
// (docs/tip-erosion.md).
//
//   tip_erosion [--surfaces ridges,grooves,sandpaper,clay_pot,cable_tie,protoboard] [--repeats 2] [--seed 1]
//               [--imperfection 1] [--radius_error 0] [--speed_mps 0.025]
//
// Straight strokes without wander, so that the surface under the path is known: z(s) in the comparison's band.
// `ridges`: crests of 100° without a radius, 0.15 mm high, every 0.8 to 2 mm on the flat. `grooves`: V grooves 0.3 mm
// wide and 0.1 mm deep, narrower than the tip. With --radius_error 0.2 the erosion is told a radius 20 % too large.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/true_profile.h"
#include "asperity/profile/bound_tip_radius.h"
#include "asperity/profile/compare_profiles.h"
#include "asperity/profile/erode_profile.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

struct Choice {
  std::vector<std::string> surfaces{"ridges", "grooves", "sandpaper", "clay_pot", "cable_tie", "protoboard"};
  int repeats = 2;
  std::int64_t seed = 1;
  double imperfection = 1.0, radius_error = 0.0, speed_mps = 0.025;
};

// Wedges along the stroke at random places: up or down, with straight flanks.
class Wedges final : public asperity::Surface {
 public:
  Wedges(double height_m, double half_width_m, std::uint64_t seed) : height_m_(height_m), half_width_m_(half_width_m) {
    asperity::Random random(seed, 30);
    for (double x = -0.06; x < 0.06; x += random.uniform(0.8e-3, 2e-3)) middles_m_.push_back(x);
  }
  double height_m(double along_m, double) const override {
    const auto next = std::lower_bound(middles_m_.begin(), middles_m_.end(), along_m);
    double away_m = half_width_m_;
    if (next != middles_m_.end()) away_m = std::min(away_m, *next - along_m);
    if (next != middles_m_.begin()) away_m = std::min(away_m, along_m - *(next - 1));
    return height_m_ * (1.0 - away_m / half_width_m_);
  }

 private:
  double height_m_, half_width_m_;
  std::vector<double> middles_m_;
};

std::unique_ptr<asperity::Surface> surface_of(const std::string& name, asperity::SimulationConfig& config,
                                              std::uint64_t seed) {
  if (name == "ridges" || name == "grooves") {
    config = asperity::make_simulation_config("sandpaper", "open");
    if (name == "ridges") return std::make_unique<Wedges>(0.15e-3, 0.15e-3 * std::tan(0.8727), seed);
    return std::make_unique<Wedges>(-0.1e-3, 0.15e-3, seed);
  }
  config = asperity::make_simulation_config(name, "open");
  return asperity::make_surface(config.surface, seed);
}

// The RMS difference where the tip touched.
double touched_um(const asperity::AlignedProfiles& aligned, const asperity::Profile& profile,
                  const std::vector<char>& touched) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < aligned.heights.s_m.size(); ++i) {
    const double difference_m = aligned.heights.measured_m[i] - aligned.heights.true_m[i];
    const double place =
        (aligned.heights.s_m[i] - aligned.comparison.shift_m - profile.s_m.front()) / profile.spacing_m;
    const auto at = std::lround(place);
    if (!std::isfinite(difference_m) || at < 0 || at >= static_cast<long>(touched.size())) continue;
    if (touched[static_cast<std::size_t>(at)] == 0) continue;
    sum += difference_m * difference_m;
    count += 1.0;
  }
  return count > 0.0 ? 1e6 * std::sqrt(sum / count) : 0.0;
}

void run(const Choice& choice, const std::string& name, std::int64_t seed) {
  asperity::SimulationConfig config;
  const auto surface = surface_of(name, config, static_cast<std::uint64_t>(seed));
  config.seed = seed;
  config.hand.lateral_wander_m = 0.0;
  config.hand.speed_mps = choice.speed_mps;
  config.calibration.imperfection = choice.imperfection;
  const asperity::Recording recording = asperity::simulate_recording(config, *surface);
  asperity::ProcessConfig process;
  process.profile.tip.mode = asperity::TipMode::kErode;
  process.profile.tip.radius_m = (1.0 + choice.radius_error) * config.contact.tip_radius_m;
  const asperity::ProcessResult result = asperity::process_recording(recording, process);
  std::vector<double> s_m, z_m;
  for (double s = 0.0; s < config.hand.length_m; s += 5e-6) {
    s_m.push_back(s);
    z_m.push_back(surface->height_m(s - 0.5 * config.hand.length_m, 0.0));
  }
  asperity::ComparisonConfig comparison;
  comparison.high_cycles_per_mm = result.accuracy->band_high_cycles_per_mm;
  const auto aligned = [&](const std::vector<double>& height_m) {
    return asperity::align_profiles(result.profile.s_m, height_m, s_m, z_m, comparison);
  };
  const asperity::ErodedProfile& eroded = *result.surface;
  const asperity::AlignedProfiles tip = aligned(result.profile.height_m), under = aligned(eroded.surface_m);
  const asperity::TipRadiusBound bound = asperity::bound_tip_radius(result.measured_profile, result.measured_noise);
  asperity::TextureNoise little;  // the truth has none: 1 nm
  little.frequency_cycles_per_mm = {0.0, 20.0};
  little.added_psd_m2_mm = {5e-20, 5e-20};
  little.added_rms_m = 1e-9;
  little.added_rms_stderr_m = 0.0;
  const asperity::TipRadiusBound of_truth =
      asperity::bound_tip_radius(asperity::true_profile(*recording.truth, process.profile), little);
  std::printf(
      "| %s %lld | %.1f | %.1f | %.2f | %.1f | %.1f | %s | %.2f | %.1f | %.1f | %.2f | %.3f (%.0f µm) | %.3f (%.0f µm) "
      "|\n",
      name.c_str(), static_cast<long long>(seed), tip.comparison.rms_um, under.comparison.rms_um,
      under.comparison.rms_um / tip.comparison.rms_um, touched_um(tip, result.profile, eroded.touched),
      touched_um(under, result.profile, eroded.touched), eroded.determined ? "yes" : "no",
      1e6 * eroded.correction_rms_m, 1e6 * eroded.noise_rms_m, 1e6 * eroded.bias_m, eroded.touched_share,
      1e3 * bound.at_most_m, 1e6 * bound.smoothing_m, 1e3 * of_truth.at_most_m, 1e6 * of_truth.smoothing_m);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Choice choice;
    bench::read_options(argc, argv,
                        {{"--surfaces", bench::list_into(choice.surfaces)},
                         {"--repeats", bench::whole_into(choice.repeats, 1.0, 1e4)},
                         {"--seed", bench::whole_into(choice.seed, 1.0, 1e9)},
                         {"--radius_error", bench::number_into(choice.radius_error, -0.9, 10.0)},
                         {"--speed_mps", bench::number_into(choice.speed_mps, 1e-3, 1.0)},
                         {"--imperfection", bench::number_into(choice.imperfection, 0.0, 10.0)}});
    std::printf(
        "| surface, seed | tip's height from surface, µm RMS | eroded, µm | ratio | the same in contact: tip, µm | "
        "eroded, µm | applied | correction, µm | noise of the erosion, µm | its mean, µm | contact | radius at most, "
        "mm "
        "|\n");
    std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& surface : choice.surfaces) {
      for (int i = 0; i < choice.repeats; ++i) run(choice, surface, choice.seed + i);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tip_erosion: %s\n", error.what());
    return 1;
  }
}
