#include "asperity/profile/measure_length_error.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>

#include "synthetic_path.h"

namespace asperity {
namespace {

using namespace synthetic;

constexpr double kSigma_m = 40e-6;
constexpr double kLevel_m = 0.1e-3;

// A scan of which the base is known exactly.
struct Known {
  Scan scan;
  BasePathResult base;
};

Known know(const std::function<Point(double)>& path, double seconds) {
  Known out;
  out.scan = make_scan(path, [](double) { return 0.0; }, {.rate_hz = 500.0, .duration_s = seconds});
  for (std::size_t i = 0; i < out.scan.motion.size(); ++i) {
    out.base.path.p_world_m.push_back(out.scan.motion.p_world_tip_m[i]);
    out.base.path.n_world.push_back(out.scan.normal[i]);
    out.base.path.s_m.push_back(out.scan.s_m[i]);
    out.base.contact.push_back(1);
    out.scan.motion.cov_world_tip_m2.push_back(kSigma_m * kSigma_m * Eigen::Matrix3d::Identity());
  }
  return out;
}

LengthErrors errors_of(const Known& k, double tip_radius_m = 0.0, double indentation_sigma_m = 0.0) {
  return measure_length_error(k.scan.motion, k.base, k.scan.tip_in_marker_m, tip_radius_m, indentation_sigma_m);
}

TEST(LengthError, OfAStraightStrokeIsThatOfItsTwoEnds) {
  Known k =
      know(on_plane([](double t) { return Eigen::Vector2d(0.02 * t, 0.0); }, [](double t) { return 0.02 * t; }), 4.0);
  EXPECT_NEAR(errors_of(k, 0.3e-3).ends_m, std::numbers::sqrt2 * kSigma_m, 1e-9);
  EXPECT_NEAR(errors_of(k, 0.3e-3).scale_sigma, 0.0, 1e-12);
  // The tip's place in the marker moves all of it: a straight stroke of a probe that keeps its attitude is as long.
  k.scan.motion.sigma_tip_in_marker_m = Eigen::Vector3d(20e-6, 20e-6, 20e-6);
  EXPECT_NEAR(errors_of(k).ends_m, std::sqrt(2.0 * (kSigma_m * kSigma_m - 4e-10)), 1e-9);
  EXPECT_NEAR(errors_of(k).scale_sigma, 0.0, 1e-12);
  EXPECT_NEAR(errors_of(k).turned_m, 0.0, 1e-9);
}

TEST(LengthError, OfAStrokeThatTurnsRoundIsTwiceThatOfThePlaceWhereItDoes) {
  const auto x_m = [](double t) { return t < 2.0 ? 0.02 * t : 0.08 - 0.02 * t; };
  const Known k =
      know(on_plane([&](double t) { return Eigen::Vector2d(x_m(t), 0.0); }, [](double t) { return 0.02 * t; }), 4.0);
  EXPECT_NEAR(errors_of(k).turned_m, 2.0 * kSigma_m, 1e-9);
}

// Made: errors that fade within 0.5 s (first-order Markov) move the points of rows that are joined by half circles; the
// length along the true directions, less what the ends do. One row takes 0.8 s: the errors of two turns are not
// independent. 2,000 draws know a spread to 1.6 %; steps of 1 mm and turns of 1.25 mm add some 3 %.
TEST(LengthError, OfARasterIsTheSpreadOfWhatFadingErrorsDoToIt) {
  constexpr double kSpeed_mps = 0.025, kRow_m = 0.02, kTurn_m = 1.25e-3, kFades_s = 0.5;
  const double turn_m = std::numbers::pi * kTurn_m;
  const auto at = [&](double t) {
    const double s_m = kSpeed_mps * t, each_m = kRow_m + turn_m;
    const int row = static_cast<int>(s_m / each_m);
    const double within_m = s_m - row * each_m, side = row % 2 == 0 ? 1.0 : -1.0;
    const double angle = std::max(0.0, within_m - kRow_m) / kTurn_m;
    const double x_m = std::min(within_m, kRow_m) + kTurn_m * std::sin(angle);
    return Eigen::Vector2d(side > 0.0 ? x_m : kRow_m - x_m, kTurn_m * (2.0 * row + 1.0 - std::cos(angle)));
  };
  const Known k = know(on_plane(at, [&](double t) { return kSpeed_mps * t; }), 6.0);
  const std::vector<Eigen::Vector3d>& p_m = k.base.path.p_world_m;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, kSigma_m);
  const double kept = std::exp(-1.0 / (500.0 * kFades_s)), fresh = std::sqrt(1.0 - kept * kept);
  double square = 0.0;
  constexpr int kDraws = 2000;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto three = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
    Eigen::Vector3d error_m = three(), along = (p_m[1] - p_m[0]).normalized();
    double added_m = 0.0;
    for (std::size_t i = 2; i < p_m.size(); ++i) {
      error_m = kept * error_m + fresh * three();
      const Eigen::Vector3d next = (p_m[i] - p_m[i - 1]).normalized();
      added_m -= error_m.dot(next - along);
      along = next;
    }
    square += added_m * added_m / kDraws;
  }
  EXPECT_NEAR(errors_of(k).turned_m, std::sqrt(square), 0.06 * std::sqrt(square));
}

// A marker that follows the normals of a cylinder: a tip that is δ further out goes round a radius larger by δ.
TEST(LengthError, OfAWrongTipOverACylinderIsItsShareOfTheRadius) {
  constexpr double kRadius_m = 0.05, kTip_m = 0.2e-3;
  Known k = know(across_cylinder(kRadius_m, 0.02, true), 3.0);
  const double unknown_level = std::hypot(
      kLevel_m,
      std::sqrt(kSigma_m * kSigma_m - kTip_m * kTip_m > 0.0 ? (kSigma_m * kSigma_m - kTip_m * kTip_m) / 3.0 : 0.0));
  k.scan.motion.sigma_tip_in_marker_m = Eigen::Vector3d(0.0, 0.0, kTip_m);
  EXPECT_NEAR(errors_of(k).scale_sigma, std::hypot(kTip_m, unknown_level) / kRadius_m, 0.01 * kTip_m / kRadius_m);
}

// A tip that is 0.4 mm deep goes round a radius that is 0.4 mm smaller.
TEST(LengthError, OfAnUnknownIndentationIsItsShareOfTheRadius) {
  const Known k = know(across_cylinder(0.05, 0.02, true), 3.0);
  const double without = errors_of(k).scale_sigma, with = errors_of(k, 0.0, 0.4e-3).scale_sigma;
  EXPECT_NEAR(std::sqrt(with * with - without * without), 0.4e-3 / 0.05, 0.01 * 0.4e-3 / 0.05);
}

// Measured by making the error: the tip's path recomputed with another tip, its length by small chords.
TEST(LengthError, OfATipThatTiltsIsTheChangeOfItsPath) {
  Known k =
      know(on_plane([](double t) { return Eigen::Vector2d(0.02 * t, 0.0); }, [](double t) { return 0.02 * t; }), 4.0);
  const Eigen::Vector3d along = (k.base.path.p_world_m.back() - k.base.path.p_world_m.front()).normalized();
  const Eigen::Vector3d axis = k.scan.normal[0].cross(along);
  const Eigen::Vector3d wrong(0.05e-3, -0.03e-3, 0.1e-3);
  double length_m = 0.0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < k.scan.motion.size(); ++i) {
    const double lean = 0.3 * k.scan.s_m[i] / 0.08;  // rad, over the stroke
    Eigen::Quaterniond& q = k.scan.motion.q_world_marker[i];
    q = Eigen::Quaterniond(Eigen::AngleAxisd(lean, axis)) * q;
    const Eigen::Vector3d p = k.base.path.p_world_m[i] + q * wrong;
    if (i > 0) length_m += along.dot(p - before);
    before = p;
  }
  const double change_m = std::abs(length_m - 0.08);
  // One axis at a time, so that signs are known: the standard error is the root of the sum of the three squares.
  double square = 0.0, sum_m = 0.0;
  for (int axis_number = 0; axis_number < 3; ++axis_number) {
    k.scan.motion.sigma_tip_in_marker_m = Eigen::Vector3d::Zero();
    k.scan.motion.sigma_tip_in_marker_m[axis_number] = std::abs(wrong[axis_number]);
    square += std::pow(0.08 * errors_of(k).scale_sigma, 2);
    sum_m += 0.08 * errors_of(k).scale_sigma;
  }
  k.scan.motion.sigma_tip_in_marker_m = wrong.cwiseAbs();
  EXPECT_NEAR(0.08 * errors_of(k).scale_sigma, std::sqrt(square), 1e-9);
  EXPECT_GE(1.02 * sum_m, change_m);
  EXPECT_GT(change_m, 10e-6);
}

TEST(LengthError, IsNothingWithoutACovariance) {
  Known k = know(across_cylinder(0.05, 0.02, true), 3.0);
  k.scan.motion.cov_world_tip_m2.clear();
  EXPECT_EQ(errors_of(k).ends_m, 0.0);
  EXPECT_EQ(errors_of(k).scale_sigma, 0.0);
}

}  // namespace
}  // namespace asperity
