#include "simulated_hand.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/device/make_stroke.h"

namespace asperity {

namespace {

// The hand's equations by brute force: classical Runge–Kutta with 1 µs on the path as given.
struct FineHand {
  HandModelConfig config;
  HandPath path;
  Eigen::Vector3d n;
  Eigen::Vector3d p, v;
  double r = 0.0;
  std::int64_t t_ns = 0;

  FineHand(const HandModelConfig& c, const HandPath& q) : config(c), path(q), n(c.press_direction.data()) {
    n.normalize();
    p = q.front().p_m;
    v.setZero();
  }

  // Of the segment that the step from `step_ns` lies in.
  void path_at(std::int64_t step_ns, double t_s, Eigen::Vector3d& q, Eigen::Vector3d& u, double& press_N) const {
    std::size_t i = 0;
    while (i + 1 < path.size() && path[i + 1].t_ns <= step_ns) ++i;
    q = path[i].p_m;
    u.setZero();
    press_N = path[i].press_N;
    if (i + 1 == path.size()) return;
    const double span_s = static_cast<double>(path[i + 1].t_ns - path[i].t_ns) * 1e-9;
    const double x = (t_s - static_cast<double>(path[i].t_ns) * 1e-9) / span_s;
    u = (path[i + 1].p_m - path[i].p_m) / span_s;
    q += x * (path[i + 1].p_m - path[i].p_m);
    press_N += x * (path[i + 1].press_N - path[i].press_N);
  }

  using State = Eigen::Matrix<double, 7, 1>;
  State slope(std::int64_t step_ns, double t_s, const State& s, const Eigen::Vector3d& f) const {
    Eigen::Vector3d q, u;
    double press_N = 0.0;
    path_at(step_ns, t_s, q, u, press_N);
    const Eigen::Vector3d e = s.head<3>() - q, ev = s.segment<3>(3) - u;
    const double en = n.dot(e), evn = n.dot(ev), fn = n.dot(f);
    const Eigen::Vector3d et = e - en * n, evt = ev - evn * n, ft = f - fn * n;
    State d;
    d.head<3>() = s.segment<3>(3);
    d.segment<3>(3) =
        (-config.across_stiffness_N_per_m * et - config.across_damping_N_s_per_m * evt + ft) / config.across_mass_kg +
        n * ((-config.press_stiffness_N_per_m * (en - s[6]) - config.press_damping_N_s_per_m * evn + press_N + fn) /
             config.press_mass_kg);
    d[6] = (en - s[6]) / config.press_adaptation_s;
    return d;
  }

  void advance(std::int64_t to_ns, const Eigen::Vector3d& f) {
    constexpr std::int64_t kStep_ns = 1000;
    while (t_ns < to_ns) {
      const double t = static_cast<double>(t_ns) * 1e-9, h = static_cast<double>(kStep_ns) * 1e-9;
      State s;
      s << p, v, r;
      const State k1 = slope(t_ns, t, s, f), k2 = slope(t_ns, t + h / 2, s + h / 2 * k1, f);
      const State k3 = slope(t_ns, t + h / 2, s + h / 2 * k2, f), k4 = slope(t_ns, t + h, s + h * k3, f);
      s += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      p = s.head<3>();
      v = s.segment<3>(3);
      r = s[6];
      t_ns += kStep_ns;
    }
  }
};

HandPath bent_path() {
  return {{0, {0.0, 0.0, 0.0}, 0.0},
          {20'500'000, {0.0, 0.0, 0.0}, 1.0},
          {60'300'000, {2e-3, 0.5e-3, -1e-3}, 0.7},
          {110'000'000, {1e-3, 1e-3, 2e-3}, 0.2}};
}

}  // namespace

// Random forces held for a tick, knots inside ticks, an oblique press direction.
TEST(SimulatedHand, AgreesWithFineIntegration) {
  HandModelConfig config;
  config.press_direction = {1.0, -2.0, 0.5};
  SimulatedHand hand(config, bent_path());
  FineHand fine(config, bent_path());
  Random random(7);
  double worst_m = 0.0, worst_mps = 0.0;
  for (std::int64_t t_ns = 1'000'000; t_ns <= 150'000'000; t_ns += 1'000'000) {
    const Eigen::Vector3d f(random.normal(), random.normal(), random.normal());
    hand.advance(t_ns, f);
    fine.advance(t_ns, f);
    worst_m = std::max(worst_m, (hand.p_m() - fine.p).norm());
    worst_mps = std::max(worst_mps, (hand.v_mps() - fine.v).norm());
  }
  // Rounding of 150,000 steps.
  EXPECT_LT(worst_m, 1e-10);
  EXPECT_LT(worst_mps, 1e-8);
}

// The exact step does not depend on how an interval is cut.
TEST(SimulatedHand, StepsCompose) {
  const Eigen::Vector3d f(0.3, 0.4, -0.2);
  SimulatedHand whole({}, bent_path());
  SimulatedHand cut({}, bent_path());
  whole.advance(150'000'000, f);
  for (std::int64_t t_ns = 0; t_ns <= 150'000'000; t_ns += 250'000) cut.advance(t_ns, f);
  EXPECT_LT((whole.p_m() - cut.p_m()).norm(), 1e-14);
  EXPECT_LT((whole.v_mps() - cut.v_mps()).norm(), 1e-12);
}

// Held still by a force, the hand yields until the surface bears exactly the pressing force.
TEST(SimulatedHand, PressesWithItsForceOnAWall) {
  HandModelConfig config;
  const double wall_y_m = -1.3e-3;
  constexpr double kStiffness_N_per_m = 2000.0;
  constexpr double kPress_N = 0.8;
  SimulatedHand hand(config, {{0, {0, 0, 0}, kPress_N}, {1, {0, 0, 0}, kPress_N}});
  double f_N = 0.0;
  for (std::int64_t t_ns = 0; t_ns <= 6'000'000'000; t_ns += 1'000'000) {
    hand.advance(t_ns, {0.0, f_N, 0.0});
    f_N = kStiffness_N_per_m * std::max(0.0, wall_y_m - hand.p_m().y());
  }
  EXPECT_NEAR(f_N, kPress_N, 1e-9);
  EXPECT_NEAR(hand.p_m().y(), wall_y_m - kPress_N / kStiffness_N_per_m, 1e-12);
}

// In the air the hand sinks with F/(b + k τ), to F/k below its reach.
TEST(SimulatedHand, SinksSlowlyAndNotBeyondItsReach) {
  HandModelConfig config;
  const HandPath path = {{0, {0, 0, 0}, 1.0}, {1, {0, 0, 0}, 1.0}};
  SimulatedHand hand(config, path);
  for (std::int64_t t_ns = 0; t_ns <= 1'000'000'000; t_ns += 1'000'000) hand.advance(t_ns, Eigen::Vector3d::Zero());
  const double sinking_mps =
      1.0 / (config.press_damping_N_s_per_m + config.press_stiffness_N_per_m * config.press_adaptation_s);
  EXPECT_NEAR(hand.v_mps().y(), -sinking_mps, 1e-6);
  for (std::int64_t t_ns = 1'000'000'000; t_ns <= 9'000'000'000; t_ns += 1'000'000) {
    hand.advance(t_ns, Eigen::Vector3d::Zero());
  }
  EXPECT_NEAR(hand.p_m().y(), -(config.reach_m + 1.0 / config.press_stiffness_N_per_m),
              1.4e-5);  // what r creeps between two instants: (F/k)/τ · 1 ms
}

// A sampled wall puts energy in: with K above the stability bound of the closed loop, its swing grows; below, it
// dies. The bound is that of the discrete system, whose transition matrix is written down here for m and b alone.
TEST(SimulatedHand, SampledWallIsUnstableExactlyAboveItsBound) {
  HandModelConfig config;
  config.press_stiffness_N_per_m = 0.0;
  const double m = config.press_mass_kg, b = config.press_damping_N_s_per_m, T = 1e-3;
  const double decay = std::exp(-b * T / m);
  // p⁺ = p + (1 − decay) m/b v + g f, v⁺ = decay v + (1 − decay)/b f, f = −K p.
  const double g = T / b - m / (b * b) * (1.0 - decay);
  const double h = (1.0 - decay) / b;
  // Characteristic polynomial z² − (1 + decay − K g) z + decay − K g decay + K h (1 − decay) m/b; |z| = 1 when its
  // constant term is 1.
  const double bound_N_per_m = (1.0 - decay) / (h * (1.0 - decay) * m / b - g * decay);
  for (const double factor : {0.9, 1.1}) {
    SimulatedHand hand(config, {{0, {0, 0, 0}, 0.0}, {1, {0, 0, 0}, 0.0}});
    hand.advance(1'000'000, {0.0, 1.0, 0.0});
    double early_m = 0.0, late_m = 0.0;
    for (std::int64_t i = 2; i <= 400; ++i) {
      hand.advance(i * 1'000'000, {0.0, -factor * bound_N_per_m * hand.p_m().y(), 0.0});
      double& swing_m = i < 100 ? early_m : late_m;
      if (i < 100 || i > 300) swing_m = std::max(swing_m, std::abs(hand.p_m().y()));
    }
    EXPECT_EQ(late_m > early_m, factor > 1.0) << "K = " << factor * bound_N_per_m << " N/m";
  }
}

TEST(SimulatedHand, RefusesWhatCannotBe) {
  EXPECT_THROW(SimulatedHand({}, {}), Error);
  EXPECT_THROW(SimulatedHand({}, {{5, {0, 0, 0}, 0.0}, {5, {0, 0, 0}, 0.0}}), Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SimulatedHand({}, {{0, {0, nan, 0}, 0.0}}), Error);
  EXPECT_THROW(SimulatedHand({}, {{0, {0, 0, 0}, nan}}), Error);
  EXPECT_THROW(SimulatedHand({}, {{std::numeric_limits<std::int64_t>::max(), {0, 0, 0}, 0.0}}), Error);
  HandModelConfig config;
  config.press_direction = {0.0, 0.0, 0.0};
  EXPECT_THROW(SimulatedHand(config, {{0, {0, 0, 0}, 0.0}}), Error);
  config = {};
  config.press_mass_kg = 0.0;
  EXPECT_THROW(SimulatedHand(config, {{0, {0, 0, 0}, 0.0}}), Error);
}

TEST(MakeStroke, RunsAsAsked) {
  HandStrokeConfig config;
  config.start_m = {0.01, 0.02, 0.03};
  config.direction = {0.0, 3.0, 4.0};
  config.length_m = 0.05;
  config.speed_mps = 0.02;
  const HandPath path = make_stroke(config);
  ASSERT_EQ(path.size(), 6u);
  EXPECT_EQ(path.front().t_ns, 0);
  EXPECT_EQ(path.front().press_N, 0.0);
  EXPECT_EQ(path.back().press_N, 0.0);
  EXPECT_EQ(path[3].t_ns - path[2].t_ns, 2'500'000'000);
  EXPECT_NEAR((path[3].p_m - Eigen::Vector3d(0.01, 0.05, 0.07)).norm(), 0.0, 1e-15);
  EXPECT_EQ(path[3].press_N, config.press_N);
  config.direction = {0.0, 0.0, 0.0};
  EXPECT_THROW(make_stroke(config), Error);
  config = {};
  config.speed_mps = 0.0;
  EXPECT_THROW(make_stroke(config), Error);
}

}  // namespace asperity
