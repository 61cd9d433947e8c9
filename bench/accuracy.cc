// The virtual bench's accuracy: surface × probe × method × speed, medians over several seeds, in the band of
// docs/profile.md (0.15 to min(4, 0.4·rate/speed) cycles/mm). Prints a table in Markdown.
//
//   accuracy [--seeds N] [--speeds 20,25,45] [--probes open,what] [--methods fused,thesis] [--surfaces …]
//            [--faults no]   without flipped and lost poses, spikes and lost samples
//            [--set probe.true_rate_Hz=4000,probe.quantise=false]   settings of the bench, after all others

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

using asperity::Error;

struct Options {
  int seeds = 5;
  bool faults = true;
  std::vector<std::string> surfaces{"sine", "protoboard", "cable_tie", "sandpaper", "clay_pot"};
  std::vector<std::string> probes{"open", "what"};
  std::vector<std::string> methods{"fused", "thesis"};
  std::vector<std::string> speeds{"20", "25", "45"};
  std::vector<std::string> settings;  // key=value
};

Options parse_options(int argc, char** argv) {
  Options out;
  bench::read_options(argc, argv,
                      {{"--seeds", [&](auto value) { out.seeds = bench::seed_count(value); }},
                       {"--faults", [&](auto value) { out.faults = bench::is_first(value, "yes", "no"); }},
                       {"--surfaces", [&](auto value) { out.surfaces = bench::split_list(value); }},
                       {"--probes", [&](auto value) { out.probes = bench::split_list(value); }},
                       {"--methods", [&](auto value) { out.methods = bench::split_list(value); }},
                       {"--set", [&](auto value) { out.settings = bench::split_list(value); }},
                       {"--speeds", [&](auto value) { out.speeds = bench::split_list(value); }}});
  return out;
}

// The figures of one method over the seeds.
struct Column {
  std::vector<double> correlation, gain, rms_um, length_error_percent, position_rms_mm;
  double true_rms_um = 0.0;
  int failed = 0;  // no profile to compare

  void add(const asperity::ProcessResult& result) {
    if (!result.accuracy || !result.accuracy->profile || !std::isfinite(result.accuracy->profile->correlation)) {
      ++failed;
      return;
    }
    const auto& profile = *result.accuracy->profile;
    correlation.push_back(profile.correlation);
    gain.push_back(profile.gain);
    rms_um.push_back(profile.rms_um);
    length_error_percent.push_back(std::abs(profile.length_error_percent));
    position_rms_mm.push_back(1e3 * result.accuracy->position_rms_m);
    true_rms_um = profile.true_rms_um;
  }

  void print(std::string_view row) const {
    if (correlation.empty()) {
      std::printf("| %s | | | | | | | %d |\n", std::string(row).c_str(), failed);
      return;
    }
    std::printf("| %s | %.3f | %.3f | %.3f | %.1f of %.0f | %.2f | %.3f | %d |\n", std::string(row).c_str(),
                asperity::median(correlation), *std::min_element(correlation.begin(), correlation.end()),
                asperity::median(gain), asperity::median(rms_um), true_rms_um, asperity::median(length_error_percent),
                asperity::median(position_rms_mm), failed);
  }
};

void run(const Options& options) {
  std::printf(
      "| surface | probe | mm/s | method | correlation | lowest | gain | RMS error, µm | length error, %% | position, "
      "mm | failed |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& probe : options.probes) {
    for (const auto& speed : options.speeds) {
      const auto speed_mm_s = asperity::parse_double(speed);
      if (!speed_mm_s) throw Error("--speeds: '" + speed + "' is not a number");
      for (const auto& surface : options.surfaces) {
        std::vector<Column> columns(options.methods.size());
        for (int seed = 1; seed <= options.seeds; ++seed) {
          asperity::SimulationConfig config = asperity::make_simulation_config(surface, probe);
          config.seed = seed;
          config.hand.speed_mps = 1e-3 * *speed_mm_s;
          if (!options.faults) {
            config.tracker.flip_chance = config.tracker.dropout_chance = 0.0;
            config.probe.spike_chance = config.probe.dropout_chance = 0.0;
          }
          for (const std::string& setting : options.settings) {
            const std::size_t equals = setting.find('=');
            if (equals == std::string::npos) throw Error("--set: '" + setting + "' is not KEY=VALUE");
            asperity::set_field(asperity::list_fields("", config), setting.substr(0, equals),
                                setting.substr(equals + 1));
          }
          const asperity::Recording recording = asperity::simulate_recording(config);
          for (std::size_t m = 0; m < options.methods.size(); ++m) {
            asperity::ProcessConfig process;
            asperity::set_field(asperity::list_fields("", process), "method", options.methods[m]);
            try {
              columns[m].add(asperity::process_recording(recording, process));
            } catch (const Error&) {
              ++columns[m].failed;
            }
          }
        }
        for (std::size_t m = 0; m < options.methods.size(); ++m) {
          std::string row = surface;
          for (const std::string& cell : {probe, speed, options.methods[m]}) row.append(" | ").append(cell);
          columns[m].print(row);
        }
        std::fflush(stdout);
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse_options(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "accuracy: %s\n", error.what());
    return 1;
  }
}
