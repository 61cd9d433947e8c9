// The stages of `asperity process` over 60 s of a simulated scan of sandpaper with the open probe:
// 240,000 samples, 1.5 m at 25 mm/s. One thread.
#include <benchmark/benchmark.h>

#include "asperity/profile/find_base_path.h"
#include "asperity/profile/make_profile.h"
#include "asperity/profile/make_profile_thesis.h"
#include "asperity/simulation/simulate_recording.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"
#include "asperity/trajectory/estimate_trajectory_thesis.h"

namespace asperity {

namespace {

SimulationConfig one_minute() {
  SimulationConfig config = make_simulation_config("sandpaper", "open");
  config.hand.path = HandPathShape::kBackAndForth;
  config.hand.strokes = 15;
  config.hand.length_m = 0.1;
  return config;
}

const Recording& recording() {
  static const Recording made = simulate_recording(one_minute());
  return made;
}

const TipMotion& fused_motion() {
  static const TipMotion made = estimate_trajectory_fused(recording(), {}).motion;
  return made;
}

const TipMotion& thesis_motion() {
  static const TipMotion made = estimate_trajectory_thesis(recording(), {}).motion;
  return made;
}

BasePathResult base_of(const TipMotion& motion) {
  return find_base_path(motion, recording().calibration.tip_in_marker_m, {});
}

void report_size(benchmark::State& state) { state.counters["samples"] = static_cast<double>(recording().probe.size()); }

void simulate(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(simulate_recording(one_minute()));
  report_size(state);
}

void trajectory_fused(benchmark::State& state) {
  recording();
  for (auto _ : state) benchmark::DoNotOptimize(estimate_trajectory_fused(recording(), {}));
  report_size(state);
}

void trajectory_thesis(benchmark::State& state) {
  recording();
  for (auto _ : state) benchmark::DoNotOptimize(estimate_trajectory_thesis(recording(), {}));
  report_size(state);
}

void base_path(benchmark::State& state) {
  fused_motion();
  for (auto _ : state) benchmark::DoNotOptimize(base_of(fused_motion()));
}

void profile_fused(benchmark::State& state) {
  const auto base = base_of(fused_motion());
  for (auto _ : state) benchmark::DoNotOptimize(make_profile(fused_motion(), base.path, base.contact, {}));
}

void profile_thesis(benchmark::State& state) {
  const auto base = base_of(thesis_motion());
  for (auto _ : state) benchmark::DoNotOptimize(make_profile_thesis(thesis_motion(), base.path, {}));
}

BENCHMARK(simulate)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(trajectory_fused)->Unit(benchmark::kMillisecond);
BENCHMARK(trajectory_thesis)->Unit(benchmark::kMillisecond);
BENCHMARK(base_path)->Unit(benchmark::kMillisecond);
BENCHMARK(profile_fused)->Unit(benchmark::kMillisecond);
BENCHMARK(profile_thesis)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace asperity
