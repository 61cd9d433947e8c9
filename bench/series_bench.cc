// One servo step of the time-series textures: the normalised lattice beside the direct form, with what both share.
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "asperity/base/random.h"
#include "asperity/texture/autoregressive_filter.h"
#include "asperity/texture/convert_rate.h"
#include "asperity/texture/evaluate_autoregressive.h"
#include "asperity/texture/evaluate_decaying_sinusoids.h"
#include "asperity/texture/evaluate_stochastic.h"

namespace {

using namespace asperity;

AutoregressiveTexture models(int order, int count) {
  Random random(1);
  AutoregressiveTexture t;
  for (int i = 0; i < count; ++i) {
    std::vector<double> k(static_cast<std::size_t>(order));
    for (double& v : k) v = random.uniform(-0.6, 0.6);
    t.models.push_back({random.uniform(0.0, 0.2), random.uniform(0.1, 3.0), reflection_to_lsf(k), {}, 1.0, 1.0});
  }
  prepare_autoregressive(t, "bench");
  return t;
}

// A hand that never keeps its speed: every step another filter.
struct Hand {
  double t = 0.0;
  double speed_mps = 0.0, force_N = 0.0;
  void move() {
    t += 1e-3;
    speed_mps = 0.1 + 0.08 * std::sin(9.0 * t);
    force_N = 1.5 + 1.2 * std::sin(5.3 * t);
  }
};

void autoregressive_step(benchmark::State& state) {
  const auto texture = models(static_cast<int>(state.range(0)), 60);
  SeriesState series = start_series(1);
  Hand hand;
  for (auto _ : state) {
    hand.move();
    benchmark::DoNotOptimize(next_acceleration_mps2(texture, series, hand.speed_mps, hand.force_N, 1e-3));
  }
}

// The textbook: coefficients from the mixed frequencies, x = e − Σ a x over a shifted history,
// std::normal_distribution.
void direct_form_step(benchmark::State& state) {
  const auto texture = models(static_cast<int>(state.range(0)), 60);
  const auto order = static_cast<std::size_t>(state.range(0));
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  std::vector<double> past(order, 0.0);
  Hand hand;
  for (auto _ : state) {
    hand.move();
    const auto blend = blend_models(texture, hand.speed_mps, hand.force_N, -1);
    std::vector<double> lsf(order, 0.0), a(order);
    double variance = 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
      const auto& m = texture.models[static_cast<std::size_t>(blend.model[j])];
      for (std::size_t i = 0; i < order; ++i) lsf[i] += blend.weight[j] * m.ar_lsf_rad[i];
      variance += blend.weight[j] * m.variance;
    }
    lsf_to_ar(lsf, a);
    double x = std::sqrt(variance) * normal(generator);
    for (std::size_t i = 0; i < order; ++i) x -= a[i] * past[i];
    past.pop_back();
    past.insert(past.begin(), x);
    benchmark::DoNotOptimize(x);
  }
}

void stochastic_step(benchmark::State& state) {
  const StochasticTexture texture{.sigma_m = 1e-5, .correlation_length_m = 1e-4};
  SeriesState series = start_series(1);
  Hand hand;
  for (auto _ : state) {
    hand.move();
    benchmark::DoNotOptimize(next_force(texture, series, hand.speed_mps, hand.force_N, 1e-3));
  }
}

void decaying_sinusoids_step(benchmark::State& state) {
  const DecayingSinusoids texture{.a_per_s = 100.0, .pitch_m = 1e-3};
  SeriesState series = start_series(1);
  Hand hand;
  for (auto _ : state) {
    hand.move();
    benchmark::DoNotOptimize(next_force(texture, series, hand.speed_mps, hand.force_N, 1e-3));
  }
}

void rate_conversion(benchmark::State& state) {
  const auto texture = models(16, 60);
  for (auto _ : state) benchmark::DoNotOptimize(convert_rate(texture, {.rate_Hz = 4000.0}));
}

BENCHMARK(autoregressive_step)->Arg(8)->Arg(16)->Arg(32);
BENCHMARK(direct_form_step)->Arg(8)->Arg(16)->Arg(32);
BENCHMARK(stochastic_step);
BENCHMARK(decaying_sinusoids_step);
BENCHMARK(rate_conversion)->Unit(benchmark::kMillisecond);

}  // namespace
