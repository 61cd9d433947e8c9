// The methods compared (docs/comparison.md): on the virtual bench, surface × probe × method, medians over seeds, beside
// the information bound; and on recordings of a real hand. Prints tables in Markdown.
//
//   methods [--methods fused,…] [--surfaces sine,… | none] [--probes open,what] [--seeds N] [--speed 25] [--faults no]
//           [--calibration exact] [--hand imu.csv,mocap.csv[,imu.csv,mocap.csv …]] [--cost yes]
//
// With --cost, how long each trajectory takes, which no two runs agree on.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/recording/import_imu_pose.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"
#include "information_bound.h"
#include "read_options.h"

namespace {

using asperity::Error;

struct Options {
  int seeds = 5;
  double speed_mps = 0.025;
  bool faults = true;
  bool exact = false;
  bool cost = false;
  std::vector<std::string> surfaces{"sine", "protoboard", "cable_tie", "sandpaper", "clay_pot"};
  std::vector<std::string> probes{"open", "what"};
  std::vector<std::string> methods{asperity::kMethodNames.begin(), asperity::kMethodNames.end()};
  std::vector<std::string> hands;  // pairs of files
};

Options parse_options(int argc, char** argv) {
  Options out;
  bench::read_options(argc, argv,
                      {{"--seeds", [&](auto value) { out.seeds = bench::seed_count(value); }},
                       {"--speed", [&](auto value) { out.speed_mps = 1e-3 * bench::number_within(value, 1.0, 500.0); }},
                       {"--faults", [&](auto value) { out.faults = bench::is_first(value, "yes", "no"); }},
                       {"--cost", [&](auto value) { out.cost = bench::is_first(value, "yes", "no"); }},
                       {"--calibration", [&](auto value) { out.exact = bench::is_first(value, "exact", "made"); }},
                       {"--surfaces", [&](auto value) { out.surfaces = bench::split_list(value); }},
                       {"--probes", [&](auto value) { out.probes = bench::split_list(value); }},
                       {"--methods", [&](auto value) { out.methods = bench::split_list(value); }},
                       {"--hand", [&](auto value) { out.hands = bench::split_list(value); }}});
  if (out.surfaces == std::vector<std::string>{"none"}) out.surfaces.clear();
  if (out.hands.size() % 2 != 0) throw Error("--hand: pairs of files are needed");
  return out;
}

// Mean over the motion of eᵀ C⁻¹ e / 3 at the truth's times; nan without covariances.
double normalised_square(const asperity::Recording& recording, const asperity::TipMotion& motion) {
  if (motion.cov_world_tip_m2.empty() || motion.size() < 2) return std::nan("");
  const asperity::Truth& truth = *recording.truth;
  double sum = 0.0;
  std::size_t count = 0, k = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const std::int64_t t_ns = truth.t_ns[i];
    if (t_ns < motion.t_ns.front() || t_ns > motion.t_ns.back()) continue;
    while (k + 2 < motion.size() && motion.t_ns[k + 1] <= t_ns) ++k;
    const double part =
        static_cast<double>(t_ns - motion.t_ns[k]) / static_cast<double>(motion.t_ns[k + 1] - motion.t_ns[k]);
    const Eigen::Vector3d e =
        asperity::lerp(motion.p_world_tip_m[k], motion.p_world_tip_m[k + 1], part) - truth.p_world_tip_m[i];
    sum += e.dot(motion.cov_world_tip_m2[k].inverse() * e) / 3.0;
    ++count;
  }
  return sum / static_cast<double>(count);
}

// The figures of one method over the seeds.
struct Column {
  std::vector<double> position_mm, ratio, error_over_sigma, nees, correlation, length_percent, ms_per_s, bound_mm;
  int failed = 0;

  static void print(const std::vector<double>& figures, int digits, bool sign = false) {
    std::vector<double> finite;
    std::copy_if(figures.begin(), figures.end(), std::back_inserter(finite), [](double x) { return std::isfinite(x); });
    if (finite.empty()) {
      std::printf(" | –");
    } else if (sign) {
      std::printf(" | %+.*f", digits, asperity::median(finite));
    } else {
      std::printf(" | %.*f", digits, asperity::median(finite));
    }
  }
};

void measure(const asperity::Recording& recording, const std::string& method, double bound_m, Column& column) {
  asperity::ProcessConfig config;
  try {
    asperity::set_field(asperity::list_fields("", config), "method", method);
    asperity::ProcessMethod timed = asperity::ProcessMethods::get(config.method);
    double ms = 0.0;
    const auto estimate = timed.estimate_trajectory;
    timed.estimate_trajectory = [&](const auto& r, const auto& c, const auto& observer) {
      const auto begin = std::chrono::steady_clock::now();
      asperity::TrajectoryResult out = estimate(r, c, observer);
      ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
      return out;
    };
    const asperity::ProcessResult result = asperity::process_recording(recording, config, timed, {});
    if (!result.accuracy) throw Error("no accuracy");
    const double seconds = 1e-9 * static_cast<double>(recording.probe.t_ns.back() - recording.probe.t_ns.front());
    column.position_mm.push_back(1e3 * result.accuracy->position_rms_m);
    column.ratio.push_back(result.accuracy->position_rms_m / result.accuracy->tracker_rms_m);
    column.error_over_sigma.push_back(result.accuracy->position_error_over_sigma);
    column.nees.push_back(normalised_square(recording, result.trajectory.motion));
    column.ms_per_s.push_back(ms / seconds);
    column.bound_mm.push_back(1e3 * bound_m);
    if (!result.accuracy->profile) return;
    column.correlation.push_back(result.accuracy->profile->correlation);
    column.length_percent.push_back(result.accuracy->profile->length_error_percent);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: %s\n", method.c_str(), error.what());
    ++column.failed;
  }
}

void print_head(const char* first, bool has_surface, bool cost) {
  std::printf("| %s | method | position, mm |%s of raw | error/σ | NEES |%s%s failed |\n", first,
              has_surface ? " bound, mm |" : "", has_surface ? " correlation | length, % |" : "",
              cost ? " ms per s |" : "");
  for (int i = 0; i < 7 + (has_surface ? 3 : 0) + (cost ? 1 : 0); ++i) std::printf("|---");
  std::printf("|\n");
}

void print_rows(const std::string& name, const Options& options, const std::vector<Column>& columns, bool has_surface) {
  for (std::size_t m = 0; m < options.methods.size(); ++m) {
    const Column& c = columns[m];
    std::printf("| %s | %s", name.c_str(), options.methods[m].c_str());
    Column::print(c.position_mm, 3);
    if (has_surface) Column::print(c.bound_mm, 3);
    Column::print(c.ratio, 2);
    Column::print(c.error_over_sigma, 2);
    Column::print(c.nees, 2);
    if (has_surface) {
      Column::print(c.correlation, 3);
      Column::print(c.length_percent, 2, true);
    }
    if (options.cost) Column::print(c.ms_per_s, 1);
    std::printf(" | %d |\n", c.failed);
  }
  std::fflush(stdout);
}

void compare_on_bench(const Options& options) {
  print_head("surface, probe", true, options.cost);
  for (const std::string& probe : options.probes) {
    for (const std::string& surface : options.surfaces) {
      std::vector<Column> columns(options.methods.size());
      for (int seed = 1; seed <= options.seeds; ++seed) {
        asperity::SimulationConfig config = asperity::make_simulation_config(surface, probe);
        config.seed = seed;
        config.hand.speed_mps = options.speed_mps;
        if (options.exact) config.calibration.imperfection = 0.0;
        if (!options.faults) {
          config.tracker.flip_chance = config.tracker.dropout_chance = 0.0;
          config.probe.spike_chance = config.probe.dropout_chance = 0.0;
        }
        const asperity::Recording recording = asperity::simulate_recording(config);
        const double bound_m = bench::position_bound_m(recording, config);
        for (std::size_t m = 0; m < options.methods.size(); ++m) {
          measure(recording, options.methods[m], bound_m, columns[m]);
        }
      }
      print_rows(surface + ", " + probe, options, columns, true);
    }
  }
}

void compare_on_hands(const Options& options) {
  if (options.hands.empty()) return;
  print_head("recording", false, options.cost);
  for (std::size_t h = 0; h < options.hands.size(); h += 2) {
    const asperity::ImportInput input = asperity::read_imu_pose(options.hands[h], options.hands[h + 1]);
    std::vector<Column> columns(options.methods.size());
    for (int seed = 1; seed <= options.seeds; ++seed) {
      asperity::ImportConfig config;
      config.pose_rate_Hz = 45.0;
      config.pose_noise_m = {0.15e-3, 0.13e-3, 0.54e-3};
      config.seed = seed;
      const asperity::Recording recording = asperity::import_imu_pose(input, config);
      for (std::size_t m = 0; m < options.methods.size(); ++m) {
        measure(recording, options.methods[m], std::nan(""), columns[m]);
      }
    }
    print_rows(std::filesystem::absolute(options.hands[h]).parent_path().filename().string(), options, columns, false);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parse_options(argc, argv);
    if (!options.surfaces.empty()) compare_on_bench(options);
    compare_on_hands(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "methods: %s\n", error.what());
    return 1;
  }
}
