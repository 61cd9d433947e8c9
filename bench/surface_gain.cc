// Tip and surface: how far the gain of the measured texture is from one, against the tip's true height and against the
// surface under it, without and with the contact's resonance stated (docs/profile-surface.md).
//
//   surface_gain [--scans 20] [--seed 1] [--simulator ours|second] [--families fine,…]
//
// Open probe, exact calibration; scans faster than 30 mm/s are left out. The surface under the tip is the tip's height
// and the static indentation that belongs to the true contact force.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/signal/statistics.h"
#include "coverage/scan_case.h"
#include "read_options.h"
#include "second_bench/second_scan.h"

namespace {

constexpr double kOwnMass_kg = 0.04;  // HandConfig::normal_mass_kg
constexpr double kFastest_mps = 0.03;

// The contact's stiffness at the mean force, and the exponent of F ~ δ^p.
struct Contact {
  double stiffness_N_per_m, power, mass_kg;
};

Contact contact_of(const bench::ScanCase& scan, bool ours) {
  if (ours) return {1e3 * scan.stiffness_N_per_mm, 1.0, kOwnMass_kg};
  const second_bench::ScanPlan plan = second_bench::draw_plan(scan.seed, scan.family, scan.probe);
  return {1e3 * scan.stiffness_N_per_mm, plan.contact == second_bench::Contact::kHuntCrossley ? 1.5 : 1.0,
          plan.probe_mass_kg};
}

asperity::Recording with_surface(asperity::Recording recording, const Contact& contact) {
  asperity::Truth& truth = *recording.truth;
  std::vector<double> touching;
  for (const double force_N : truth.force_N)
    if (force_N > 0.0) touching.push_back(force_N);
  const double mean_N = asperity::mean(touching), depth_m = contact.power * mean_N / contact.stiffness_N_per_m;
  for (std::size_t i = 0; i < truth.height_m.size(); ++i)
    truth.height_m[i] += depth_m * std::pow(std::max(0.0, truth.force_N[i]) / mean_N, 1.0 / contact.power);
  return recording;
}

struct Column {
  std::vector<double> gain, correlation;

  void add(const asperity::ProcessResult& result) {
    gain.push_back(result.accuracy->profile->gain);
    correlation.push_back(result.accuracy->profile->correlation);
  }
  void print(const char* name) {
    std::printf("| %s | %.3f | %.3f | %.3f | %.4f | %.4f |\n", name, asperity::percentile(gain, 10.0),
                asperity::median(gain), asperity::percentile(gain, 90.0), asperity::median(correlation),
                asperity::percentile(correlation, 10.0));
  }
};

}  // namespace

int main(int argc, char** argv) {
  try {
    int scans = 20;
    std::uint64_t seed = 1;
    bool ours = true;
    bench::CaseChoice choice{{"fine"}, {"open"}, true};
    bench::read_options(
        argc, argv,
        {{"--scans", [&](auto value) { scans = static_cast<int>(bench::number_within(value, 1.0, 1e6)); }},
         {"--seed", [&](auto value) { seed = static_cast<std::uint64_t>(bench::number_within(value, 0.0, 1e12)); }},
         {"--simulator", [&](auto value) { ours = bench::is_first(value, "ours", "second"); }},
         {"--families", [&](auto value) { choice.families = bench::split_list(value); }}});
    Column tip, surface, corrected;
    std::vector<double> resonances_Hz;
    for (int i = 0; i < scans; ++i) {
      const std::uint64_t number = seed * 1'000'000 + static_cast<std::uint64_t>(i);
      const bench::ScanCase scan =
          ours ? bench::simulate_own_case(number, choice) : bench::simulate_second_case(number, choice);
      const asperity::ProcessResult of_tip = asperity::process_recording(scan.recording, {});
      // What is not measured has no gain.
      if (!(of_tip.noise.snr > 10.0) || of_tip.speed.mean_mps > kFastest_mps || !of_tip.accuracy ||
          !of_tip.accuracy->profile)
        continue;
      const Contact contact = contact_of(scan, ours);
      const double resonance_Hz = std::sqrt(contact.stiffness_N_per_m / contact.mass_kg) / (2.0 * std::numbers::pi);
      if (resonance_Hz > 0.19 * scan.recording.info.probe_rate_Hz) continue;
      const asperity::Recording recording = with_surface(scan.recording, contact);
      asperity::ProcessConfig config;
      tip.add(of_tip);
      surface.add(asperity::process_recording(recording, config));
      config.profile.contact_resonance_Hz = resonance_Hz;
      corrected.add(asperity::process_recording(recording, config));
      resonances_Hz.push_back(resonance_Hz);
    }
    if (resonances_Hz.empty()) throw asperity::Error("no scan with a texture above its noise");
    std::printf("%zu scans, resonance of the contact %.0f to %.0f Hz, median %.0f Hz\n\n", resonances_Hz.size(),
                *std::min_element(resonances_Hz.begin(), resonances_Hz.end()),
                *std::max_element(resonances_Hz.begin(), resonances_Hz.end()), asperity::median(resonances_Hz));
    std::printf("| | gain, 10 %% | median | 90 %% | correlation, median | 10 %% |\n|---|---|---|---|---|---|\n");
    tip.print("against the tip");
    surface.print("against the surface");
    corrected.print("against the surface, resonance stated");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "surface_gain: %s\n", error.what());
    return 1;
  }
}
