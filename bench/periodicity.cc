// How often random profiles are called periodic, and which patterns are found in noise: find_periodicity_under_noise()
// over synthetic profiles of 40 to 140 mm. Prints tables in Markdown (docs/periodicity.md).
//
//   periodicity [--profiles 300] [--patterns 20] [--paths straight|arcs]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/random.h"
#include "asperity/profile/find_periodicity_under_noise.h"
#include "periodicity/draw_profiles.h"
#include "read_options.h"

namespace {

using asperity::Random;

constexpr double kSpacing_mm = bench::kProfileSpacing_mm;
constexpr double kRq_m = bench::kProfileRq_m;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

// White noise of this RMS, as it is known of a measurement.
asperity::TextureNoise white_noise(double rms_m) {
  asperity::TextureNoise out;
  const double highest = 0.5 / kSpacing_mm;
  out.frequency_cycles_per_mm = {0.0, highest};
  out.added_psd_m2_mm = {rms_m * rms_m / highest, rms_m * rms_m / highest};
  out.misplaced_psd_m2_mm = {0.0, 0.0};
  out.added_rms_m = out.noise_rms_m = rms_m;
  out.added_rms_stderr_m = out.noise_rms_stderr_m = 0.05 * rms_m;
  return out;
}

asperity::Periodicity find(std::vector<double> height_m, double noise_m, Random& random,
                           std::span<const Eigen::Vector2d> path_m = {}) {
  for (double& h : height_m) h += noise_m * random.normal();
  return find_periodicity_under_noise(height_m, 1e-3 * kSpacing_mm, white_noise(noise_m), {}, path_m);
}

// Over straight paths, or over arcs.
void print_false_alarms(int profiles, bool arcs) {
  const std::vector<bench::ProfileFamily>& families = bench::random_families();
  std::printf("| random profile%s | profiles | periodic | %% | of these below 12 periods |\n|---|---|---|---|---|\n",
              arcs ? ", on arcs of 2 to 12 mm" : "");
  int all = 0, all_found = 0;
  for (const bench::ProfileFamily& family : families) {
    int found = 0, few = 0;
    for (int k = 0; k < profiles; ++k) {
      Random random(static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(&family - families.data()));
      const double length_mm = bench::log_uniform(random, 40.0, 140.0);
      const std::vector<double> height_m = family.draw(static_cast<std::size_t>(length_mm / kSpacing_mm), random);
      const std::vector<Eigen::Vector2d> path_m =
          arcs ? bench::draw_arc(random.uniform(2.0, 12.0), height_m.size()) : std::vector<Eigen::Vector2d>{};
      const asperity::Periodicity p = find(height_m, 0.02 * kRq_m, random, path_m);
      found += p.periodic ? 1 : 0;
      few += p.periodic && length_mm < 12e3 * p.pitch_m ? 1 : 0;
    }
    std::printf("| %s | %d | %d | %.2f | %d |\n", family.name, profiles, found, 100.0 * found / profiles, few);
    std::fflush(stdout);
    all += profiles;
    all_found += found;
  }
  std::printf("| all | %d | %d | %.2f | |\n", all, all_found, 100.0 * all_found / all);
}

void print_patterns(int patterns) {
  constexpr double kLength_mm = 80.0;
  const std::vector<double> signals{15.0, 20.0, 30.0, 40.0, 60.0, 80.0, 160.0, 1e4};
  std::printf("\n| pattern | jitter | periods |");
  for (const double signal : signals) std::printf(" %g |", signal);
  std::printf("\n|---|---|---|");
  for (std::size_t k = 0; k < signals.size(); ++k) std::printf("---|");
  std::printf("\n");
  const auto points = static_cast<std::size_t>(kLength_mm / kSpacing_mm);
  for (const char* shape : {"sine", "triangle", "saw", "ribs"}) {
    for (const double jitter : {0.0, 0.03}) {
      for (const double periods : {10.0, 20.0, 40.0, 160.0}) {
        std::printf("| %s | %g %% | %g |", shape, 100.0 * jitter, periods);
        for (const double signal : signals) {
          int right = 0;
          for (int k = 0; k < patterns; ++k) {
            Random random(static_cast<std::uint64_t>(k), 77);
            const double pitch_mm = kLength_mm / periods * random.uniform(0.98, 1.02);
            const std::vector<double> height_m = bench::draw_pattern(shape, pitch_mm, jitter, points, random);
            // All of the pattern's power, were it in one line, is `signal` times the noise's density there.
            const double noise_m = kRq_m * std::sqrt(0.5 * static_cast<double>(points) / signal);
            const asperity::Periodicity p = find(height_m, noise_m, random);
            right += p.periodic && std::abs(1e3 * p.pitch_m / pitch_mm - 1.0) < 0.05 ? 1 : 0;
          }
          std::printf(" %.0f |", 100.0 * right / patterns);
        }
        std::printf("\n");
        std::fflush(stdout);
      }
    }
  }
}

// Straight ribs of a pitch, across which an arc of 8 mm over 80 mm goes; their normal is turned from its chord.
void print_arcs(int patterns) {
  constexpr double kLength_mm = 80.0, kSagitta_mm = 8.0;
  const std::vector<double> signals{20.0, 40.0, 80.0, 160.0, 1e4};
  std::printf("\n| pattern on an arc | ribs rotated | periods | path |");
  for (const double signal : signals) std::printf(" %g |", signal);
  std::printf(" pitch across over its σ, RMS |\n|---|---|---|---|");
  for (std::size_t k = 0; k < signals.size(); ++k) std::printf("---|");
  std::printf("---|\n");
  const auto points = static_cast<std::size_t>(kLength_mm / kSpacing_mm);
  const std::vector<Eigen::Vector2d> path_m = bench::draw_arc(kSagitta_mm, points);
  for (const char* shape : {"sine", "ribs"}) {
    for (const double turned_deg : {0.0, 20.0, 35.0}) {
      for (const double periods : {10.0, 20.0, 40.0, 160.0}) {
        for (const bool known : {false, true}) {
          std::printf("| %s | %g° | %g | %s |", shape, turned_deg, periods, known ? "known" : "not known");
          double square = 0.0, count = 0.0;
          for (const double signal : signals) {
            int right = 0;
            for (int k = 0; k < patterns; ++k) {
              Random random(static_cast<std::uint64_t>(k), 78);
              const double pitch_mm = kLength_mm / periods * random.uniform(0.98, 1.02);
              const double turned = turned_deg * kTwoPi / 360.0, phase = random.uniform();
              const Eigen::Vector2d across(std::cos(turned), std::sin(turned));
              std::vector<double> height_m;
              for (const Eigen::Vector2d& at_m : path_m) {
                const double u = 1e3 * across.dot(at_m) / pitch_mm + phase;
                height_m.push_back(bench::shape_at(shape, u - std::floor(u)));
              }
              height_m = bench::scaled(std::move(height_m), kRq_m);
              const double noise_m = kRq_m * std::sqrt(0.5 * static_cast<double>(points) / signal);
              const asperity::Periodicity p =
                  find(height_m, noise_m, random, known ? path_m : std::vector<Eigen::Vector2d>{});
              const bool has_across = std::isfinite(p.across_pitch_m);
              // Along the path the pitch is that across the ribs, over the cosines of the angles up to that of the end.
              const double ratio = 1e3 * (has_across ? p.across_pitch_m : p.pitch_m * std::cos(turned)) / pitch_mm;
              right += p.periodic && std::abs(ratio - 1.0) < (has_across ? 0.05 : 0.1) ? 1 : 0;
              if (!p.periodic || !has_across || !(std::abs(ratio - 1.0) < 0.05)) continue;
              square += std::pow((1e3 * p.across_pitch_m - pitch_mm) / (1e3 * p.across_pitch_stderr_m), 2.0);
              count += 1.0;
            }
            std::printf(" %.0f |", 100.0 * right / patterns);
          }
          if (count > 0.0) {
            std::printf(" %.2f |\n", std::sqrt(square / count));
          } else {
            std::printf(" – |\n");
          }
          std::fflush(stdout);
        }
      }
    }
  }
}

// Holes on a square lattice under arcs of 80 mm, 8 mm high, and isotropic reliefs under arcs of 2 to 12 mm.
void print_lattices(int profiles, int patterns) {
  constexpr double kLength_mm = 80.0, kSagitta_mm = 8.0;
  const auto points = static_cast<std::size_t>(kLength_mm / kSpacing_mm);
  std::printf("\n| isotropic relief, on arcs of 2 to 12 mm | profiles | periodic | %% |\n|---|---|---|---|\n");
  for (const double width : {0.05, 0.2, 1.0}) {
    int found = 0;
    for (int k = 0; k < profiles; ++k) {
      Random random(static_cast<std::uint64_t>(k), 79);
      const double length_mm = bench::log_uniform(random, 40.0, 140.0);
      const std::vector<Eigen::Vector2d> path_m =
          bench::draw_arc(random.uniform(2.0, 12.0), static_cast<std::size_t>(length_mm / kSpacing_mm));
      found += find(bench::draw_relief(width, path_m, random), 0.02 * kRq_m, random, path_m).periodic ? 1 : 0;
    }
    std::printf("| waves within %g %% of a frequency | %d | %d | %.2f |\n", 100.0 * width, profiles, found,
                100.0 * found / profiles);
    std::fflush(stdout);
  }
  const std::vector<double> signals{80.0, 160.0, 320.0, 640.0, 1e4};
  std::printf("\n| lattice on an arc | periods |");
  for (const double signal : signals) std::printf(" %g |", signal);
  std::printf(" period over its σ, RMS |\n|---|---|---|---|---|---|---|---|\n");
  const std::vector<Eigen::Vector2d> path_m = bench::draw_arc(kSagitta_mm, points);
  for (const double turned_deg : {0.0, 10.0, 25.0, 45.0}) {
    for (const double periods : {15.0, 30.0, 60.0}) {
      std::printf("| rotated %g° | %g |", turned_deg, periods);
      double square = 0.0, count = 0.0;
      for (const double signal : signals) {
        int right = 0;
        for (int k = 0; k < patterns; ++k) {
          Random random(static_cast<std::uint64_t>(k), 80);
          const double pitch_mm = kLength_mm / periods * random.uniform(0.98, 1.02);
          const std::vector<double> height_m =
              bench::draw_holes(1e-3 * pitch_mm, turned_deg * kTwoPi / 360.0, path_m, random);
          const double noise_m = kRq_m * std::sqrt(0.5 * static_cast<double>(points) / signal);
          const asperity::Periodicity p = find(height_m, noise_m, random, path_m);
          // Without the path, as by its rows of holes.
          const double found_mm = 1e3 * (std::isfinite(p.across_pitch_m) ? p.across_pitch_m : p.pitch_m);
          const bool is_right = p.periodic && std::abs(found_mm / pitch_mm - 1.0) < 0.05;
          right += is_right ? 1 : 0;
          if (!is_right || !std::isfinite(p.across_pitch_m)) continue;
          square += std::pow((1e3 * p.across_pitch_m - pitch_mm) / (1e3 * p.across_pitch_stderr_m), 2.0);
          count += 1.0;
        }
        std::printf(" %.0f |", 100.0 * right / patterns);
      }
      count > 0.0 ? std::printf(" %.2f |\n", std::sqrt(square / count)) : std::printf(" – |\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    int profiles = 300, patterns = 20;
    bool arcs = false;
    bench::read_options(
        argc, argv,
        {{"--profiles", [&](auto value) { profiles = static_cast<int>(bench::number_within(value, 1.0, 1e6)); }},
         {"--patterns", [&](auto value) { patterns = static_cast<int>(bench::number_within(value, 1.0, 1e6)); }},
         {"--paths", [&](auto value) { arcs = bench::is_first(value, "arcs", "straight"); }}});
    print_false_alarms(profiles, arcs);
    arcs ? print_arcs(patterns) : print_patterns(patterns);
    if (arcs) print_lattices(profiles, patterns);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "periodicity: %s\n", error.what());
    return 1;
  }
}
