// How often random profiles are called periodic, and which patterns are found in noise: find_periodicity_under_noise()
// over synthetic profiles of 40 to 140 mm. Prints tables in Markdown (docs/periodicity.md).
//
//   periodicity [--profiles 300] [--patterns 20] [--paths straight|arcs]

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <exception>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/random.h"
#include "asperity/profile/find_periodicity_under_noise.h"
#include "asperity/signal/spectrum.h"
#include "read_options.h"

namespace {

using asperity::Random;

constexpr double kSpacing_mm = 0.025;
constexpr double kRq_m = 10e-6;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

double log_uniform(Random& random, double low, double high) {
  return low * std::exp(random.uniform() * std::log(high / low));
}

double exponential(Random& random) { return -std::log(1.0 - random.uniform()); }

std::vector<double> scaled(std::vector<double> x, double rms) {
  double mean = 0.0, square = 0.0;
  for (const double v : x) mean += v / static_cast<double>(x.size());
  for (double& v : x) v -= mean;
  for (const double v : x) square += v * v / static_cast<double>(x.size());
  for (double& v : x) v *= rms / std::sqrt(square);
  return x;
}

// Gaussian, of the density `psd` over cycles/mm, through a high-pass at 0.1 cycles/mm as a texture has it. Cut out of
// twice its length: the transform's own period must not show.
std::vector<double> draw_gaussian(const std::function<double(double)>& psd, std::size_t points, Random& random) {
  std::size_t n = 16;
  while (n < 2 * points) n *= 2;
  std::vector<std::complex<double>> half(n / 2 + 1, 0.0);
  for (std::size_t k = 1; k + 1 < half.size(); ++k) {
    const double f = static_cast<double>(k) / (static_cast<double>(n) * kSpacing_mm);
    const double high_pass = 1.0 / (1.0 + 0.414 * std::pow(0.1 / f, 4.0));
    const double real = random.normal(), imaginary = random.normal();
    half[k] = high_pass * std::sqrt(psd(f)) * std::complex<double>(real, imaginary);
  }
  std::vector<double> out = asperity::inverse_real_dft(half, n);
  out.resize(points);
  return scaled(std::move(out), kRq_m);
}

std::vector<double> draw_peak(double width, double floor, std::size_t points, Random& random) {
  const double centre = log_uniform(random, 0.2, 3.0);
  return draw_gaussian([&](double f) { return floor + std::exp(-0.5 * std::pow((f / centre - 1.0) / width, 2.0)); },
                       points, random);
}

std::vector<double> draw_band(double floor, std::size_t points, Random& random) {
  const double low = log_uniform(random, 0.1, 1.0), high = log_uniform(random, 1.5, 8.0);
  return draw_gaussian([&](double f) { return f > low && f < high ? 1.0 : floor; }, points, random);
}

std::vector<double> draw_fractal(double slope, std::size_t points, Random& random) {
  return draw_gaussian([&](double f) { return std::pow(f, -slope); }, points, random);
}

// Straight from one random height to the next, at random places.
std::vector<double> draw_facets(std::size_t points, Random& random) {
  const double mean_mm = log_uniform(random, 0.15, 1.5);
  double from_mm = 0.0, to_mm = mean_mm * exponential(random), low = random.normal(), high = random.normal();
  std::vector<double> out(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double at_mm = static_cast<double>(i) * kSpacing_mm;
    while (at_mm > to_mm) {
      from_mm = to_mm;
      to_mm += mean_mm * exponential(random);
      low = high;
      high = random.normal();
    }
    out[i] = low + (high - low) * (at_mm - from_mm) / (to_mm - from_mm);
  }
  return scaled(std::move(out), kRq_m);
}

// Plateaus 0.5 to 1.5 times a mean length long, joined by steep ramps.
std::vector<double> draw_plateaus(std::size_t points, Random& random) {
  const double mean_mm = random.uniform(1.0, 3.0), ramp_mm = 0.2;
  double to_mm = mean_mm * random.uniform(0.5, 1.5), low = random.normal(), high = random.normal();
  std::vector<double> out(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double at_mm = static_cast<double>(i) * kSpacing_mm;
    while (at_mm > to_mm + ramp_mm) {
      to_mm += ramp_mm + mean_mm * random.uniform(0.5, 1.5);
      low = high;
      high = random.normal();
    }
    out[i] = low + (high - low) * std::clamp((at_mm - to_mm) / ramp_mm, 0.0, 1.0);
  }
  return scaled(std::move(out), kRq_m);
}

// A relief of so many plane waves in random directions, as simulators make it: lines, each with that part of the power.
std::vector<double> draw_waves(int waves, std::size_t points, Random& random) {
  std::vector<double> out(points, 0.0);
  for (int w = 0; w < waves; ++w) {
    const double f = 0.25 * std::pow(10.0, (w + random.uniform()) / waves) * std::cos(kTwoPi * random.uniform());
    const double phase = kTwoPi * random.uniform();
    for (std::size_t i = 0; i < points; ++i)
      out[i] += std::cos(kTwoPi * f * kSpacing_mm * static_cast<double>(i) + phase);
  }
  return scaled(std::move(out), kRq_m);
}

std::vector<double> with_gaps(std::vector<double> x, Random& random) {
  const int count = 1 + static_cast<int>(3.0 * random.uniform());
  for (int k = 0; k < count; ++k) {
    const auto n = static_cast<double>(x.size());
    const auto length = static_cast<std::size_t>(n * random.uniform(0.01, 0.15));
    const auto from = static_cast<std::size_t>(random.uniform() * static_cast<double>(x.size() - length));
    std::fill_n(x.begin() + static_cast<std::ptrdiff_t>(from), length, std::numeric_limits<double>::quiet_NaN());
  }
  return x;
}

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

// An arc of a circle of this height over its chord.
std::vector<Eigen::Vector2d> draw_arc(double sagitta_mm, std::size_t points) {
  const double length_mm = kSpacing_mm * static_cast<double>(points - 1);
  // sagitta = r (1 − cos(turn/2)), length = r turn.
  double low = 1e-6, high = std::numbers::pi;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    ((1.0 - std::cos(0.5 * middle)) / middle * length_mm < sagitta_mm ? low : high) = middle;
  }
  const double radius_mm = length_mm / low;
  std::vector<Eigen::Vector2d> out;
  for (std::size_t i = 0; i < points; ++i) {
    const double angle = kSpacing_mm * static_cast<double>(i) / radius_mm - 0.5 * low;
    out.emplace_back(1e-3 * radius_mm * std::sin(angle), 1e-3 * radius_mm * std::cos(angle));
  }
  return out;
}

struct Family {
  const char* name;
  std::function<std::vector<double>(std::size_t, Random&)> draw;
};

const std::vector<Family>& random_families() {
  static const std::vector<Family> families{
      {"white", [](auto n, Random& r) { return draw_gaussian([](double) { return 1.0; }, n, r); }},
      {"white, a band with sharp edges", [](auto n, Random& r) { return draw_band(0.0, n, r); }},
      {"the same with gaps", [](auto n, Random& r) { return with_gaps(draw_band(1e-3, n, r), r); }},
      {"f^−1", [](auto n, Random& r) { return draw_fractal(1.0, n, r); }},
      {"f^−2", [](auto n, Random& r) { return draw_fractal(2.0, n, r); }},
      {"f^−3", [](auto n, Random& r) { return draw_fractal(3.0, n, r); }},
      {"f^−3 with gaps", [](auto n, Random& r) { return with_gaps(draw_fractal(3.0, n, r), r); }},
      {"f^−4", [](auto n, Random& r) { return draw_fractal(4.0, n, r); }},
      {"a peak of relative width 5 %", [](auto n, Random& r) { return draw_peak(0.05, 0.0, n, r); }},
      {"a peak of 5 % over a floor", [](auto n, Random& r) { return draw_peak(0.05, 0.01, n, r); }},
      {"a peak of 10 %", [](auto n, Random& r) { return draw_peak(0.1, 1e-3, n, r); }},
      {"a peak of 10 % with gaps", [](auto n, Random& r) { return with_gaps(draw_peak(0.1, 1e-3, n, r), r); }},
      {"a peak of 20 %", [](auto n, Random& r) { return draw_peak(0.2, 1e-3, n, r); }},
      {"a peak of 50 %", [](auto n, Random& r) { return draw_peak(0.5, 1e-3, n, r); }},
      {"facets", [](auto n, Random& r) { return draw_facets(n, r); }},
      {"plateaus", [](auto n, Random& r) { return draw_plateaus(n, r); }},
      {"300 plane waves", [](auto n, Random& r) { return draw_waves(300, n, r); }},
      {"160 plane waves", [](auto n, Random& r) { return draw_waves(160, n, r); }},
  };
  return families;
}

// Over straight paths, or over arcs.
void print_false_alarms(int profiles, bool arcs) {
  const std::vector<Family>& families = random_families();
  std::printf("| random profile%s | profiles | periodic | %% | of these below 12 periods |\n|---|---|---|---|---|\n",
              arcs ? ", on arcs of 2 to 12 mm" : "");
  int all = 0, all_found = 0;
  for (const Family& family : families) {
    int found = 0, few = 0;
    for (int k = 0; k < profiles; ++k) {
      Random random(static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(&family - families.data()));
      const double length_mm = log_uniform(random, 40.0, 140.0);
      const std::vector<double> height_m = family.draw(static_cast<std::size_t>(length_mm / kSpacing_mm), random);
      const std::vector<Eigen::Vector2d> path_m =
          arcs ? draw_arc(random.uniform(2.0, 12.0), height_m.size()) : std::vector<Eigen::Vector2d>{};
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

// One period, from −1 to 1.
double shape_at(const std::string& shape, double u) {
  if (shape == "sine") return std::sin(kTwoPi * u);
  if (shape == "triangle") return u < 0.5 ? 4.0 * u - 1.0 : 3.0 - 4.0 * u;
  if (shape == "saw") return u < 0.75 ? u / 0.375 - 1.0 : 1.0 - (u - 0.75) / 0.125;
  return u < 0.45 ? -std::cos(kTwoPi * u / 0.45) : -1.0;  // ribs
}

// Each period is longer or shorter by `jitter`, relative, and so moves all that follow.
std::vector<double> draw_pattern(const std::string& shape, double pitch_mm, double jitter, std::size_t points,
                                 Random& random) {
  double from_mm = -pitch_mm * random.uniform(), to_mm = from_mm + pitch_mm;
  std::vector<double> out(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double at_mm = static_cast<double>(i) * kSpacing_mm;
    while (at_mm >= to_mm) {
      from_mm = to_mm;
      to_mm += pitch_mm * std::max(0.2, 1.0 + jitter * random.normal());
    }
    out[i] = shape_at(shape, (at_mm - from_mm) / (to_mm - from_mm));
  }
  return scaled(std::move(out), kRq_m);
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
            const std::vector<double> height_m = draw_pattern(shape, pitch_mm, jitter, points, random);
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
  std::printf("\n| pattern on an arc | ribs turned | periods | path |");
  for (const double signal : signals) std::printf(" %g |", signal);
  std::printf(" pitch across over its σ, RMS |\n|---|---|---|---|");
  for (std::size_t k = 0; k < signals.size(); ++k) std::printf("---|");
  std::printf("---|\n");
  const auto points = static_cast<std::size_t>(kLength_mm / kSpacing_mm);
  const std::vector<Eigen::Vector2d> path_m = draw_arc(kSagitta_mm, points);
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
                height_m.push_back(shape_at(shape, u - std::floor(u)));
              }
              height_m = scaled(std::move(height_m), kRq_m);
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
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "periodicity: %s\n", error.what());
    return 1;
  }
}
