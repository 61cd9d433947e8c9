// Why the baseline's lengths are too long (docs/thesis-method.md): the median length error of `thesis` over seeds, with
// one thing after the other taken away or changed, without flips, lost poses, spikes and lost samples. Prints a table
// in Markdown.
//
//   thesis_length [--seeds N] [--surface sine] [--probe open]

#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/profile/thesis_steps.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

using asperity::ProcessConfig;
using asperity::SimulationConfig;

struct Variant {
  std::string name;
  std::function<void(SimulationConfig&, ProcessConfig&)> change;
};

void still_hand(SimulationConfig& s) {
  s.hand.tremor_lateral_m = s.hand.tremor_normal_m = s.hand.tremor_along_m = s.hand.tremor_rotation_rad = 0.0;
}

std::vector<Variant> variants() {
  return {
      {"unchanged", [](auto&, auto&) {}},
      {"no rotation noise",
       [](auto& s, auto&) {
         s.tracker.noise_rad = {0, 0, 0};
       }},
      {"no position noise",
       [](auto& s, auto&) {
         s.tracker.noise_m = {0, 0, 0};
       }},
      {"no tracker noise",
       [](auto& s, auto&) {
         s.tracker.noise_m = s.tracker.noise_rad = {0, 0, 0};
       }},
      {"no tremor", [](auto& s, auto&) { still_hand(s); }},
      {"no tracker noise, no tremor",
       [](auto& s, auto&) {
         s.tracker.noise_m = s.tracker.noise_rad = {0, 0, 0};
         still_hand(s);
       }},
      {"exact calibration", [](auto& s, auto&) { s.calibration.imperfection = 0.0; }},
      {"tracker at 45 Hz", [](auto& s, auto&) { s.tracker.rate_Hz = 45.0; }},
      {"tracker at 45 Hz, no rotation noise",
       [](auto& s, auto&) {
         s.tracker.rate_Hz = 45.0;
         s.tracker.noise_rad = {0, 0, 0};
       }},
      {"10 mm/s", [](auto& s, auto&) { s.hand.speed_mps = 0.010; }},
      {"50 mm/s", [](auto& s, auto&) { s.hand.speed_mps = 0.050; }},
      {"80 mm/s", [](auto& s, auto&) { s.hand.speed_mps = 0.080; }},
      {"50 mm/s, tracker at 45 Hz",
       [](auto& s, auto&) {
         s.hand.speed_mps = 0.050;
         s.tracker.rate_Hz = 45.0;
       }},
      {"80 mm/s, Q as for 25 mm/s",
       [](auto& s, auto& p) {
         s.hand.speed_mps = 0.080;
         p.thesis.trajectory.scan_speed_mps = 0.025;
       }},
      {"no static interval before and after", [](auto& s, auto&) { s.hand.rest_s = 0.0; }},
      {"two thirds of the tracker noise",
       [](auto& s, auto&) {
         for (double& x : s.tracker.noise_m) x *= 2.0 / 3.0;
         for (double& x : s.tracker.noise_rad) x *= 2.0 / 3.0;
       }},
      {"no rotation noise, tracker at 45 Hz, τ = 100 s",
       [](auto& s, auto& p) {
         s.tracker.rate_Hz = 45.0;
         s.tracker.noise_rad = {0, 0, 0};
         p.thesis.trajectory.velocity_time_s = 100.0;
       }},
      {"τ = 30 s", [](auto&, auto& p) { p.thesis.trajectory.velocity_time_s = 30.0; }},
      {"τ = 100 s", [](auto&, auto& p) { p.thesis.trajectory.velocity_time_s = 100.0; }},
      {"position_fraction = 0", [](auto&, auto& p) { p.thesis.trajectory.position_fraction = 0.0; }},
      {"position_fraction = 0, τ = 100 s",
       [](auto&, auto& p) {
         p.thesis.trajectory.position_fraction = 0.0;
         p.thesis.trajectory.velocity_time_s = 100.0;
       }},
      {"the path every 22 ms, not 5 ms", [](auto&, auto& p) { p.thesis.trajectory.period_s = 0.022; }},
      {"tuned by likelihood",
       [](auto&, auto& p) { p.method = asperity::ProcessMethods::method<asperity::ThesisTunedMethod>(); }},
  };
}

// How much too long the summed distance is between a quarter and three quarters of the true path, %.
double middle_error_percent(const asperity::Recording& recording, const asperity::ProcessResult& result) {
  const asperity::Truth& truth = *recording.truth;
  const asperity::TipMotion& motion = result.trajectory.motion;
  const std::vector<double> s_m = asperity::path_length_m(result.base.path.p_world_m);
  const double full_m = truth.s_m.back() - truth.s_m.front();
  const auto measured_at = [&](double part) {
    const double want_m = truth.s_m.front() + part * full_m;
    std::size_t i = 0;
    while (i + 1 < truth.size() && truth.s_m[i] < want_m) ++i;
    std::size_t k = 0;
    while (k + 1 < motion.size() && motion.t_ns[k] < truth.t_ns[i]) ++k;
    return s_m[k];
  };
  return 100.0 * ((measured_at(0.75) - measured_at(0.25)) / (0.5 * full_m) - 1.0);
}

void run(int seeds, const std::string& surface, const std::string& probe) {
  std::printf("| changed | length too long by, %% | in the middle half by, %% | position, mm |\n|---|---|---|---|\n");
  for (const Variant& variant : variants()) {
    std::vector<double> length_percent, middle_percent, position_mm;
    for (int seed = 1; seed <= seeds; ++seed) {
      SimulationConfig simulation = asperity::make_simulation_config(surface, probe);
      simulation.seed = seed;
      simulation.tracker.flip_chance = simulation.tracker.dropout_chance = 0.0;
      simulation.probe.spike_chance = simulation.probe.dropout_chance = 0.0;
      ProcessConfig process;
      process.method = asperity::ProcessMethods::method<asperity::ThesisMethod>();
      variant.change(simulation, process);
      const asperity::Recording recording = asperity::simulate_recording(simulation);
      const asperity::ProcessResult result = asperity::process_recording(recording, process);
      if (!result.accuracy || !result.accuracy->profile) continue;
      length_percent.push_back(result.accuracy->profile->length_error_percent);
      middle_percent.push_back(middle_error_percent(recording, result));
      position_mm.push_back(1e3 * result.accuracy->position_rms_m);
    }
    if (length_percent.empty()) {
      std::printf("| %s | – | – | – |\n", variant.name.c_str());
    } else {
      std::printf("| %s | %.1f | %.1f | %.3f |\n", variant.name.c_str(), asperity::median(length_percent),
                  asperity::median(middle_percent), asperity::median(position_mm));
    }
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    int seeds = 5;
    std::string surface = "sine", probe = "open";
    bench::read_options(argc, argv,
                        {{"--seeds", [&](auto value) { seeds = bench::seed_count(value); }},
                         {"--surface", [&](auto value) { surface = value; }},
                         {"--probe", [&](auto value) { probe = value; }}});
    run(seeds, surface, probe);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "thesis_length: %s\n", error.what());
    return 1;
  }
}
