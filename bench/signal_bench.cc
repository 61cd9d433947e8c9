// Resampling, zero-phase filtering and Verlet integration of a million samples, one by one and together.
// peers/ does the same chain in SciPy and Octave on the same numbers; compare_peers.sh runs all of them.
#include <cmath>
#include <cstddef>
#include <vector>

#include <benchmark/benchmark.h>

#include "asperity/profile/thesis_steps.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/zero_phase.h"

namespace {

constexpr std::size_t kSamples = 1'000'000;
constexpr double kPeriod_s = 0.25e-3;
constexpr double kSpacing_mm = 0.025;
constexpr double kCutoff_cycles_per_mm = 0.4;

struct Input {
  std::vector<double> a_mps2;
  std::vector<double> s_mm;  // uneven, as a hand moves

  Input() : a_mps2(kSamples), s_mm(kSamples) {
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double k = static_cast<double>(i);
      a_mps2[i] = std::sin(0.05 * k) + 0.5 * std::cos(0.31 * k);
      s_mm[i] = kSpacing_mm * (k + 0.3 * std::sin(0.7 * k));
    }
  }
};

const Input& input() {
  static const Input made;
  return made;
}

std::vector<double> resampled_m(const std::vector<double>& height_m) {
  return asperity::resample_uniform(input().s_mm, height_m, 0.0, kSpacing_mm, kSamples - 1);
}

// Of the middle half, where no tool's way with the ends is felt.
double rms_m(const std::vector<double>& x) {
  const std::size_t first = x.size() / 4;
  const std::size_t end = 3 * x.size() / 4;
  double sum = 0.0;
  for (std::size_t i = first; i < end; ++i) sum += x[i] * x[i];
  return std::sqrt(sum / static_cast<double>(end - first));
}

void verlet(benchmark::State& state) {
  input();
  for (auto _ : state) benchmark::DoNotOptimize(asperity::integrate_verlet(input().a_mps2, kPeriod_s));
}

void resample(benchmark::State& state) {
  const auto height_m = asperity::integrate_verlet(input().a_mps2, kPeriod_s);
  for (auto _ : state) benchmark::DoNotOptimize(resampled_m(height_m));
}

void filtfilt(benchmark::State& state) {
  const auto height_m = resampled_m(asperity::integrate_verlet(input().a_mps2, kPeriod_s));
  const auto sections = asperity::zero_phase_highpass_pass(kCutoff_cycles_per_mm, 1.0 / kSpacing_mm);
  for (auto _ : state) benchmark::DoNotOptimize(asperity::zero_phase_filter(height_m, sections));
}

void chain(benchmark::State& state) {
  input();
  std::vector<double> texture_m;
  for (auto _ : state) {
    texture_m = asperity::zero_phase_highpass(resampled_m(asperity::integrate_verlet(input().a_mps2, kPeriod_s)),
                                              kCutoff_cycles_per_mm, 1.0 / kSpacing_mm);
    benchmark::DoNotOptimize(texture_m);
  }
  state.counters["rms_m"] = rms_m(texture_m);
}

BENCHMARK(verlet)->Unit(benchmark::kMillisecond);
BENCHMARK(resample)->Unit(benchmark::kMillisecond);
BENCHMARK(filtfilt)->Unit(benchmark::kMillisecond);
BENCHMARK(chain)->Unit(benchmark::kMillisecond);

}  // namespace
