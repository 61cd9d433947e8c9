// From a surface to its haptic texture: simulate a scan, process it, compare it with the truth.
//
//   01_scan_to_texture [SURFACE [FILE.svg]]
//
// SURFACE is protoboard (the default), sandpaper, sine, cable_tie or clay_pot. FILE.svg gets a drawing of
// the measured over the true profile.

#include <cstdio>
#include <exception>
#include <string>
#include <variant>

#include "asperity/base/output.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/true_profile.h"
#include "asperity/simulation/simulate_recording.h"
#include "profile_plot.h"

int main(int argc, char** argv) try {
  const std::string surface = argc > 1 ? argv[1] : "protoboard";

  // What a probe and a tracker would have recorded. Every setting has a default; two are changed.
  asperity::SimulationConfig scan = asperity::make_simulation_config(surface, "open");
  scan.hand.length_m = 0.06;
  scan.hand.speed_mps = 0.025;
  const asperity::Recording recording = asperity::simulate_recording(scan);

  // All stages with their default settings.
  const asperity::ProcessConfig config;
  const asperity::ProcessResult result = asperity::process_recording(recording, config);
  for (const asperity::Problem& problem : result.problems) std::printf("note: %s\n", problem.message.c_str());

  std::printf("length       %.2f mm in %zu heights\n", 1e3 * result.coverage.length_m, result.profile.size());
  if (result.roughness) std::printf("Rq           %.1f µm\n", 1e6 * result.roughness->Rq_m);
  if (result.periodicity.periodic) {
    std::printf("pitch        %.3f ± %.3f mm\n", 1e3 * result.periodicity.pitch_m,
                1e3 * result.periodicity.pitch_stderr_m);
  }
  if (result.texture) {
    const asperity::Fourier1d& texture = std::get<asperity::Fourier1d>(result.texture->model);
    std::printf("texture      %zu harmonics over %.1f mm\n", texture.a_m.size(), texture.length_mm);
  }
  if (!result.accuracy || !result.accuracy->profile) return 1;
  const asperity::ProfileComparison& accuracy = *result.accuracy->profile;
  std::printf("correlation  %.3f with the truth from %.2f to %.1f cycles/mm\n", accuracy.correlation,
              config.comparison.low_cycles_per_mm, result.accuracy->band_high_cycles_per_mm);
  std::printf("difference   %.1f µm RMS of %.1f µm\n", accuracy.rms_um, accuracy.true_rms_um);

  if (argc > 2) {
    asperity::examples::ProfilePlot plot;
    plot.title = surface + ", 25 mm/s";
    plot.shift_m = accuracy.shift_m;
    plot.from_m = 0.02;
    plot.to_m = 0.04;
    const asperity::Profile truth = asperity::true_profile(*recording.truth, config.profile);
    asperity::write_file(argv[2], asperity::examples::profile_svg(result.profile, truth, plot));
  }
  return result.trustworthy ? 0 : 3;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
