// The compliance coefficient k_c on the virtual bench (docs/compliance.md): the tables of that page, in Markdown.
//
//   compliance repeat [--seeds N] [--surfaces …]   k_c of one surface and material for several ramps and speeds
//   compliance tilt   [--seeds N] [--surfaces …]   k_c of a leaning probe: the axial reading, corrected, three axes
//   compliance chart  [--seeds N] [--surfaces …]   k_c over the contact's stiffness, pooled over surfaces and speeds

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

using asperity::Error;

struct Options {
  int seeds = 8;
  std::vector<std::string> surfaces{"sandpaper", "clay_pot"};
};

struct Scan {
  std::string surface, material;
  double light_N = 0.3, firm_N = 2.5;
  double speed_mm_per_s = 25.0;
  double stiffness_N_per_mm = 0.0;  // 0: the material's
};

asperity::Compliance measure(const Scan& scan, int seed) {
  asperity::SimulationConfig config = asperity::make_simulation_config(scan.surface, "open", scan.material);
  config.seed = seed;
  config.hand.force = asperity::HandForce::kRamp;
  config.hand.ramp_from_N = scan.light_N;
  config.hand.ramp_to_N = scan.firm_N;
  config.hand.speed_mps = 1e-3 * scan.speed_mm_per_s;
  if (scan.stiffness_N_per_mm > 0.0) config.contact.stiffness_N_per_m = 1e3 * scan.stiffness_N_per_mm;
  return asperity::process_recording(asperity::simulate_recording(config), {}).compliance;
}

double at_percent(std::vector<double> x, double percent) {
  return x.empty() ? std::nan("") : asperity::percentile(x, percent);
}

// Each row one surface, material and ramp. The truth of an interval is the mean over all determined scans of that
// surface and material; the largest ratio is that of two scans of one seed, both determined.
void repeat(const Options& options) {
  std::printf(
      "| surface | material | ramp, N | determined | k_c, median | scatter | standard error, median | 95 %% hold |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  constexpr std::array<std::array<double, 2>, 4> kRamps{{{0.3, 0.8}, {1.0, 2.5}, {0.3, 2.5}, {0.3, 4.0}}};
  for (const std::string& surface : options.surfaces) {
    for (const char* material : {"stiff", "cork", "soft_rubber"}) {
      std::array<std::vector<asperity::Compliance>, kRamps.size()> found;
      std::vector<double> all, ratios;
      std::vector<std::vector<double>> of_seed(static_cast<std::size_t>(options.seeds));
      for (std::size_t r = 0; r < kRamps.size(); ++r) {
        for (const double speed : {20.0, 30.0, 45.0, 60.0}) {
          for (int seed = 1; seed <= options.seeds; ++seed) {
            found[r].push_back(measure({surface, material, kRamps[r][0], kRamps[r][1], speed, 0.0}, seed));
            if (!found[r].back().determined) continue;
            all.push_back(found[r].back().k_c);
            of_seed[static_cast<std::size_t>(seed - 1)].push_back(found[r].back().k_c);
          }
        }
      }
      const double truth = all.empty() ? std::nan("") : asperity::mean(all);
      for (std::size_t r = 0; r < kRamps.size(); ++r) {
        std::vector<double> k, sigma;
        double holds = 0.0;
        for (const asperity::Compliance& c : found[r]) {
          if (!c.determined) continue;
          k.push_back(c.k_c);
          sigma.push_back(c.k_c_stderr);
          holds += c.k_c_low <= truth && truth <= c.k_c_high ? 1.0 : 0.0;
        }
        const auto count = static_cast<double>(k.size());
        std::printf("| %s | %s | %.1f–%.1f | %zu of %zu | %.3f | %.3f | %.3f | %.0f %% |\n", surface.c_str(), material,
                    kRamps[r][0], kRamps[r][1], k.size(), found[r].size(), at_percent(k, 50.0),
                    k.size() > 1 ? asperity::standard_deviation(k) : std::nan(""), at_percent(sigma, 50.0),
                    100.0 * holds / count);
      }
      std::size_t near = 0, pairs = 0;
      for (const std::vector<double>& k : of_seed) {
        for (std::size_t i = 0; i < k.size(); ++i) {
          for (std::size_t j = 0; j < i; ++j) {
            ++pairs;
            near += std::abs(std::log(k[i] / k[j])) <= std::log(1.1) ? 1 : 0;
          }
        }
        if (k.size() > 1) {
          const auto [low, high] = std::minmax_element(k.begin(), k.end());
          ratios.push_back(*high / *low);
        }
      }
      std::printf("| %s | %s | all | | %.3f | | | two scans of one seed within 10 %%: %.1f %% of %zu |\n",
                  surface.c_str(), material, truth, 100.0 * static_cast<double>(near) / static_cast<double>(pairs),
                  pairs);
      std::fflush(stdout);
    }
  }
}

// k_c and its error against the one that the true contact force gives, of probes that lean along the path.
void tilt(const Options& options) {
  std::printf(
      "| lean, rad | material | reading over contact force | k_c, contact force | axial, uncorrected | corrected | "
      "three "
      "axes "
      "|\n|---|---|---|---|---|---|---|\n");
  for (const double lean : {-0.7, -0.4, 0.0, 0.4, 0.7}) {
    for (const char* material : {"cork", "soft_rubber"}) {
      std::vector<double> share, reference, read, corrected, three;
      for (const std::string& surface : options.surfaces) {
        for (int seed = 1; seed <= options.seeds; ++seed) {
          asperity::SimulationConfig config = asperity::make_simulation_config(surface, "open", material);
          config.seed = seed;
          config.hand.force = asperity::HandForce::kRamp;
          config.hand.ramp_from_N = 0.3;
          config.hand.ramp_to_N = 2.5;
          config.hand.tilt_rad[2] += lean;
          config.probe.force3 = true;
          asperity::Recording recording = asperity::simulate_recording(config);
          const asperity::ProcessResult by_three = asperity::process_recording(recording, {});
          recording.probe.force3_counts.clear();
          const asperity::ProcessResult by_axial = asperity::process_recording(recording, {});
          const auto of_force = [&](const std::vector<double>& force_N) {
            asperity::TipMotion motion = by_axial.trajectory.motion;
            motion.force_N = force_N;
            return asperity::estimate_compliance(motion, motion.t_ns, by_axial.base.path.n_world, {});
          };
          const asperity::Truth& truth = *recording.truth;
          std::vector<double> true_N(by_axial.trajectory.motion.size());
          std::size_t k = 0;
          for (std::size_t i = 0; i < true_N.size(); ++i) {
            while (k + 1 < truth.t_ns.size() && truth.t_ns[k + 1] <= by_axial.trajectory.motion.t_ns[i]) ++k;
            true_N[i] = truth.force_N[k];
          }
          const asperity::Compliance truly = of_force(true_N);
          const asperity::Compliance axial = of_force(by_axial.trajectory.motion.axial_force_N);
          if (!truly.determined || !axial.determined || !by_axial.compliance.determined ||
              !by_three.compliance.determined)
            continue;
          share.push_back(by_axial.base.force.share);
          reference.push_back(truly.k_c);
          read.push_back(std::abs(std::log(axial.k_c / truly.k_c)));
          corrected.push_back(std::abs(std::log(by_axial.compliance.k_c / truly.k_c)));
          three.push_back(std::abs(std::log(by_three.compliance.k_c / truly.k_c)));
        }
      }
      std::printf("| %.1f | %s | %.2f | %.3f | %.1f %% | %.1f %% | %.1f %% |\n", lean, material,
                  at_percent(share, 50.0), at_percent(reference, 50.0), 100.0 * at_percent(read, 50.0),
                  100.0 * at_percent(corrected, 50.0), 100.0 * at_percent(three, 50.0));
      std::fflush(stdout);
    }
  }
}

void chart(const Options& options) {
  std::printf("| stiffness, N/mm | scans | determined | k_c: 2.5 %% | median | 97.5 %% |\n|---|---|---|---|---|---|\n");
  for (const double stiffness : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 50.0, 200.0}) {
    // What goes with the stiffness: damping and friction.
    const char* material = stiffness < 4.0 ? "soft_rubber" : stiffness < 30.0 ? "cork" : "stiff";
    std::vector<double> k;
    std::size_t scans = 0;
    for (const std::string& surface : options.surfaces) {
      for (const double speed : {20.0, 30.0, 45.0, 60.0}) {
        for (int seed = 1; seed <= options.seeds; ++seed) {
          ++scans;
          const asperity::Compliance c = measure({surface, material, 0.3, 2.5, speed, stiffness}, seed);
          if (c.determined) k.push_back(c.k_c);
        }
      }
    }
    std::printf("| %.1f | %zu | %zu | %.3f | %.3f | %.3f |\n", stiffness, scans, k.size(), at_percent(k, 2.5),
                at_percent(k, 50.0), at_percent(k, 97.5));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string_view table = argc > 1 ? argv[1] : "";
    if (table != "repeat" && table != "chart" && table != "tilt")
      throw Error("the first argument must be repeat, tilt or chart");
    Options options;
    bench::read_options(argc - 1, argv + 1,
                        {{"--seeds", [&](auto value) { options.seeds = bench::seed_count(value); }},
                         {"--surfaces", [&](auto value) { options.surfaces = bench::split_list(value); }}});
    table == "repeat" ? repeat(options) : table == "tilt" ? tilt(options) : chart(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compliance: %s\n", error.what());
    return 1;
  }
}
