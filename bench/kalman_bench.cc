// The seed's position filter (§4.2) over 60 s of poses resampled every 5 ms: a state of position and
// velocity, three axes. With OpenCV installed its KalmanFilter does the same (peers/kalman_opencv.cc).
#include "peers/kalman_problem.h"

#include <benchmark/benchmark.h>

namespace {

void position_filter(benchmark::State& state) {
  const bench::KalmanProblem problem;
  for (auto _ : state)
    benchmark::DoNotOptimize(asperity::filter_position(problem.measured_m, problem.kPeriod_s, problem.noise));
}

BENCHMARK(position_filter)->Unit(benchmark::kMicrosecond);

}  // namespace
