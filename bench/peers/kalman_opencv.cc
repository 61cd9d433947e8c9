#include <algorithm>

#include <benchmark/benchmark.h>
#include <opencv2/video/tracking.hpp>

#include "kalman_problem.h"

namespace {

cv::KalmanFilter filter_for(const bench::KalmanProblem& problem) {
  cv::KalmanFilter filter(6, 3, 0, CV_64F);
  cv::setIdentity(filter.transitionMatrix);
  cv::setIdentity(filter.measurementMatrix);
  for (int axis = 0; axis < 3; ++axis) {
    filter.transitionMatrix.at<double>(axis, axis + 3) = problem.kPeriod_s;
    filter.processNoiseCov.at<double>(axis, axis) = problem.noise.process_position_m2[axis];
    filter.processNoiseCov.at<double>(axis + 3, axis + 3) = problem.noise.process_velocity_m2ps2[axis];
    filter.measurementNoiseCov.at<double>(axis, axis) = problem.noise.measurement_m2[axis];
    filter.errorCovPost.at<double>(axis, axis) = problem.noise.measurement_m2[axis];
    filter.errorCovPost.at<double>(axis + 3, axis + 3) = problem.noise.initial_velocity_m2ps2[axis];
    filter.statePost.at<double>(axis) = problem.measured_m[0][axis];
  }
  return filter;
}

void opencv_kalman_filter(benchmark::State& state) {
  const bench::KalmanProblem problem;
  std::vector<Eigen::Vector3d> p_m(problem.kSamples);
  cv::setNumThreads(1);
  for (auto _ : state) {
    cv::KalmanFilter filter = filter_for(problem);
    cv::Mat measurement(3, 1, CV_64F);
    p_m[0] = problem.measured_m[0];
    for (std::size_t i = 1; i < problem.kSamples; ++i) {
      filter.predict();
      for (int axis = 0; axis < 3; ++axis) measurement.at<double>(axis) = problem.measured_m[i][axis];
      const cv::Mat& corrected = filter.correct(measurement);
      for (int axis = 0; axis < 3; ++axis) p_m[i][axis] = corrected.at<double>(axis);
    }
    benchmark::DoNotOptimize(p_m);
  }
  const auto ours = asperity::filter_position(problem.measured_m, problem.kPeriod_s, problem.noise);
  double difference_m = 0.0;
  for (std::size_t i = 0; i < problem.kSamples; ++i)
    difference_m = std::max(difference_m, (p_m[i] - ours.p_m[i]).norm());
  state.counters["largest_difference_m"] = difference_m;
}

BENCHMARK(opencv_kalman_filter)->Unit(benchmark::kMicrosecond);

}  // namespace
