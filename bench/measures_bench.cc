// Roughness of a profile and of a map, a texture's fit and one height of it.
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include "asperity/base/random.h"
#include "asperity/profile/measure_areal_texture.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/fit_fourier1d.h"

namespace {

std::vector<double> rough_profile_m(std::size_t count) {
  asperity::Random random(1);
  std::vector<double> z;
  double walk = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    walk = 0.9 * walk + 1e-6 * random.normal();
    z.push_back(walk);
  }
  return z;
}

void roughness(benchmark::State& state) {
  const auto z = rough_profile_m(60000);
  for (auto _ : state) benchmark::DoNotOptimize(asperity::measure_roughness(z, 0.025e-3));
}

void roughness_with_cutoffs(benchmark::State& state) {
  const auto z = rough_profile_m(8000);
  for (auto _ : state)
    benchmark::DoNotOptimize(asperity::measure_roughness(z, 0.5e-6, {.lambda_s_mm = 0.0025, .lambda_c_mm = 0.8}));
}

void areal_texture(benchmark::State& state) {
  const asperity::ArealMap map{5e-6, 5e-6, 1000, 1000, rough_profile_m(1000000)};
  for (auto _ : state) benchmark::DoNotOptimize(asperity::measure_areal_texture(map));
}

void texture_fit(benchmark::State& state) {
  const auto z = rough_profile_m(60000);
  for (auto _ : state) benchmark::DoNotOptimize(asperity::fit_fourier1d(z, 0.025e-3));
}

void texture_height(benchmark::State& state) {
  const auto fit = asperity::fit_fourier1d(rough_profile_m(2000), 0.025e-3);
  double x_m = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(asperity::evaluate_height(fit.texture, x_m += 1.7e-5));
}

BENCHMARK(roughness)->Unit(benchmark::kMillisecond);
BENCHMARK(roughness_with_cutoffs)->Unit(benchmark::kMillisecond);
BENCHMARK(areal_texture)->Unit(benchmark::kMillisecond);
BENCHMARK(texture_fit)->Unit(benchmark::kMillisecond);
BENCHMARK(texture_height)->Unit(benchmark::kNanosecond);

}  // namespace
