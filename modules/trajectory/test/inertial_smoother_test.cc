// The smoother's linearisation, its score and its likelihood against finite differences.

#include "../src/inertial_smoother.h"

#include <gmock/gmock.h>
#include <cmath>
#include <vector>

#include "../src/fused_problem.h"
#include "../src/fused_setup.h"
#include "../src/inertial_forward.h"
#include "../src/inertial_model.h"
#include "../src/learning_stretches.h"
#include "../src/transition_sum.h"
#include "hand_motion.h"

namespace asperity {
namespace {

using inertial_smoother::Component;
using inertial_smoother::ForwardRecords;
using inertial_smoother::KnotLine;
using inertial_smoother::Mounting;
using inertial_smoother::Nominal;
using inertial_smoother::State;
using inertial_smoother::Step;
using inertial_smoother::TransitionSum;
using ForwardRecord = inertial_smoother::Record;
using SmootherProblem = inertial_smoother::Problem;
using Eigen::Vector3d;

// Without the streams that they are made from.
KnotLine hold(const KnotLine& knots) {
  KnotLine out;
  out.append(knots, 0, knots.size());
  return out;
}

SmootherProblem make_problem(bool has_gyro) {
  testing_motion::RestingHand hand;
  testing_motion::Sensors sensors;
  sensors.duration_s = 6.0;
  sensors.rate_Hz = 200.0;
  sensors.tracker_rate_Hz = 30.0;
  sensors.gyro = has_gyro;
  sensors.accel_in_marker = Vector3d(0.005, 0.03, -0.01);
  Recording recording = record(hand, sensors);
  recording.calibration.accelerometer.position_sigma_m = 0.002;
  const FusedConfig config;
  const InertialStream inertial = calibrate_inertial(recording, config.inertial);
  SmootherProblem out =
      inertial_smoother::make_problem(recording, inertial, config, sensors.latency_s, inertial.t_ns.front());
  out.knots = hold(out.knots);
  out.layout = inertial_smoother::choose_layout(recording.calibration, has_gyro, true, config);
  out.gravity = recording.info.gravity_world_mps2;
  inertial_smoother::set_constants(recording.calibration, has_gyro, config, out);
  out.start_covariance = inertial_smoother::prior(recording.calibration, has_gyro, config, out.layout);
  out.start = inertial_smoother::first_guess(recording, out);
  out.start.latency = -0.002;
  out.gate_innovations = false;  // every pose with its whole weight: the likelihood is smooth
  out.gate_chi2 = 1e9;
  return out;
}

// Where dead reckoning ends from a start with a small error, less where it ends without, over the error.
TEST(InertialSmoother, TheTransitionIsTheDerivativeOfDeadReckoning) {
  const SmootherProblem problem = make_problem(true);
  const auto& layout = problem.layout;
  const std::size_t first = problem.epochs[100].knot, last = problem.epochs[101].knot;
  Nominal start = problem.start;
  start.v = Vector3d(0.1, -0.05, 0.02);
  start.bg = Vector3d(0.3, -0.8, 0.5);
  const auto run = [&](const State& error, TransitionSum* sum) {
    Nominal x = start;
    inertial_smoother::apply_correction(error, layout, x);
    const Mounting mounting = inertial_smoother::mounting_of(x, problem);
    for (std::size_t k = first; k < last; ++k) {
      const Step step = inertial_smoother::advance_state(x, problem.knots[k], problem.knots[k + 1], mounting, nullptr);
      if (sum != nullptr) sum->extend(step, problem.knots[k], problem.knots[k + 1], mounting, problem.gyro_turns_too);
    }
    return x;
  };
  TransitionSum sum(problem);
  const State none = State::Zero(layout.size);
  const Nominal end = run(none, &sum);
  const auto U = sum.transition().rows(layout);
  constexpr double kSmall = 1e-5;
  for (int i = 0; i < layout.size; ++i) {
    State error = none;
    error[i] = kSmall;
    const Nominal moved = run(error, nullptr);
    Eigen::Matrix<double, 9, 1> difference;
    difference << moved.p - end.p, moved.v - end.v, log_rotation(moved.q * end.q.conjugate());
    difference /= kSmall;
    if (i < 9) difference[i] -= 1.0;
    // The integrals go sample by sample of 5 ms: rates of 1 rad/s leave half a percent of the interval's largest terms.
    const double tolerance = 6e-3 * std::max(U.col(i).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_LT((difference - U.col(i)).cwiseAbs().maxCoeff(), tolerance) << "state " << i;
  }
}

// ∂ log L / ∂ log θ = (seen − expected)/2 for every component, by central differences of the filter's likelihood:
// another pass, which knows nothing of the smoother.
void expect_score_is_derivative(const SmootherProblem& problem, const char* where) {
  const inertial_smoother::NoiseScore score =
      inertial_smoother::smooth_motion(problem, Vector3d::Zero(), false, {}).score;
  for (std::size_t i = 0; i < inertial_smoother::kComponents; ++i) {
    constexpr double kStep = 0.02;
    const auto likelihood = [&](double factor) {
      SmootherProblem scaled = problem;
      scaled.factors[i] *= factor;
      return inertial_smoother::log_likelihood(scaled);
    };
    const double derivative = (likelihood(std::exp(kStep)) - likelihood(std::exp(-kStep))) / (2.0 * kStep);
    // The filter linearises where it stands, which moves a little with the factor: 2 % and a tenth of an observation.
    EXPECT_NEAR(0.5 * (score.seen[i] - score.expected[i]), derivative, 0.1 + 0.02 * (score.seen[i] + score.expected[i]))
        << "component " << i << where;
  }
}

TEST(InertialSmoother, TheScoreIsTheDerivativeOfTheLikelihood) {
  for (const bool has_gyro : {true, false}) {
    expect_score_is_derivative(make_problem(has_gyro), has_gyro ? "" : " without a gyroscope");
  }
}

TEST(InertialSmoother, TheScoreOfStretchesIsTheDerivativeOfTheirLikelihood) {
  for (const bool has_gyro : {true, false}) {
    SmootherProblem whole = make_problem(has_gyro);
    whole.restart_covariance = whole.start_covariance;
    const SmootherProblem problem =
        inertial_smoother::problem_of_stretches(whole, {{0.2, 1.4}, {2.0, 3.1}, {4.0, 5.6}});
    ASSERT_EQ(problem.restarts.size(), 2u);
    ASSERT_GT(problem.layout.lever, 0);  // a restart ties the place to it
    ASSERT_LT(problem.knots.size(), 0.7 * static_cast<double>(whole.knots.size()));
    expect_score_is_derivative(problem, has_gyro ? "" : " without a gyroscope");
  }
}

// What the filter keeps of an epoch, as one row of numbers.
std::vector<double> numbers_of(const ForwardRecord& record, bool is_last) {
  std::vector<double> out = record.P;
  const auto add = [&](const auto& values) {
    for (const double value : values.reshaped()) out.push_back(value);
  };
  for (const Vector3d& part : {record.x.p, record.x.v, record.x.ba, record.x.bg, record.x.lever}) add(part);
  add(record.x.q.coeffs());
  out.push_back(record.x.latency);
  out.push_back(record.refused_in_a_row);
  out.push_back(record.updated ? 1.0 : 0.0);
  if (record.updated) {
    add(record.predicted.residual);
    add(record.S_inverse);
    add(record.N_inverse);
  }
  if (is_last) return out;
  for (const auto& part : {record.transition.pEg, record.transition.vEa}) add(part);
  for (const auto& part : {record.transition.g1, record.transition.g2, record.transition.vbg}) add(part);
  out.push_back(record.transition.T);
  return out;
}

// The oracle is the pass that keeps all epochs at once. Forwards and backwards, and from one end to the other, as the
// smoother and the comparison of the streams ask for them.
TEST(InertialSmoother, RecordsFilteredAgainInBlocksAreTheSameToTheLastBit) {
  const SmootherProblem problem = make_problem(true);
  const std::size_t epochs = problem.epochs.size();
  ForwardRecords whole(problem, {}, epochs);
  for (const std::size_t block : {std::size_t{1}, std::size_t{7}, std::size_t{64}, epochs - 1}) {
    ForwardRecords blocks(problem, {}, block);
    ASSERT_EQ(blocks.size(), epochs);
    const auto expect_same = [&](std::size_t e) {
      EXPECT_EQ(numbers_of(blocks.at(e), e + 1 == epochs), numbers_of(whole.at(e), e + 1 == epochs))
          << "epoch " << e << ", blocks of " << block;
    };
    for (std::size_t e = epochs; e-- > 0;) expect_same(e);
    for (std::size_t e = 0; e < epochs; ++e) expect_same(e);
    expect_same(0);
  }
}

TEST(InertialSmoother, FilteringABlockAgainCanBeCancelled) {
  const SmootherProblem problem = make_problem(true);
  bool stop = false;
  Observer observer;
  observer.cancelled = [&stop] { return stop; };
  ForwardRecords blocks(problem, observer, 16);
  stop = true;
  EXPECT_NO_THROW(blocks.at(problem.epochs.size() - 1));  // in memory
  EXPECT_THROW(blocks.at(0), Cancelled);
}

}  // namespace
}  // namespace asperity
