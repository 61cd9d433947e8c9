#include "asperity/calibration/fit_force_line.h"

#include <gmock/gmock.h>

#include <fstream>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/calibration/read_force_points.h"
#include "asperity/testkit/temp_dir.h"
#include "coverage.h"

namespace asperity {
namespace {

constexpr int kTrials = 200;

using testing::ElementsAre;
using testing::HasSubstr;

// Seed Fig. 11(a).
ForcePoints figure_11() {
  return {{48, 95, 100, 105, 115, 128, 155, 161, 185, 195},
          {0.00, 1.14, 1.24, 1.34, 1.54, 1.79, 2.29, 2.44, 3.54, 3.84}};
}

template <class Work>
std::string message_of(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FitForceLine, Figure11) {
  const ForceLineFit fit = fit_force_line(figure_11());
  EXPECT_NEAR(fit.force.newton_per_count, 0.025095, 5e-7);
  EXPECT_NEAR(fit.force.offset_newton, -1.313768, 1e-6);
  EXPECT_NEAR(fit.force.residual_newton, 0.196, 5e-4);
  EXPECT_EQ(fit.degrees_of_freedom, 8);
  EXPECT_TRUE(fit.verdict.trustworthy) << fit.verdict.text;
  EXPECT_TRUE(fit.outliers.empty());
}

TEST(FitForceLine, TwoHundredCalibrationsOfAnEightBitSensorKeepTheirErrors) {
  test::Coverage coverage;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(11, static_cast<std::uint64_t>(trial));
    const double slope = random.uniform(0.015, 0.03);
    const double offset = random.uniform(-1.5, 0.0);
    ForcePoints points;
    for (int i = 0; i < 12; ++i) {
      const double counts = std::round(random.uniform(50.0, 220.0));
      points.counts.push_back(counts);
      points.force_N.push_back(slope * counts + offset + 0.1 * random.normal());
    }
    const ForceLineFit fit = fit_force_line(points);
    coverage.add("slope", fit.force.newton_per_count, slope, fit.newton_per_count_stderr);
    coverage.add("offset", fit.force.offset_newton, offset, fit.offset_newton_stderr);
  }
  coverage.expect("force line, 12 points", kTrials);
}

TEST(FitForceLine, ABentSensorIsLimitedByItsBend) {
  ForcePoints points;
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const double counts = 50.0 + 9.0 * i;
    points.counts.push_back(counts);
    points.force_N.push_back(0.02 * counts + 4e-5 * (counts - 135.0) * (counts - 135.0) + 0.01 * random.normal());
  }
  const ForceLineFit fit = fit_force_line(points);
  EXPECT_LT(fit.bend_probability, 1e-6);
  // The parabola less its own line, at the ends: 4e-5·(u² − mean u²) with u = ±85.5, mean u² = 81·(400 − 1)/12.
  EXPECT_NEAR(fit.bend_newton, 4e-5 * (85.5 * 85.5 - 81.0 * 399.0 / 12.0), 0.02);
  EXPECT_EQ(verdict_word(fit.verdict.verdicts), "limited");
  EXPECT_THAT(fit.verdict.text, HasSubstr("not linear"));
}

TEST(FitForceLine, NamesASaturatedEndAndAnOutlier) {
  ForcePoints saturated = figure_11();
  for (const double force_N : {4.2, 4.6, 5.0}) {
    saturated.counts.push_back(195);
    saturated.force_N.push_back(force_N);
  }
  const ForceLineFit end = fit_force_line(saturated);
  EXPECT_THAT(end.saturated, ElementsAre(9, 10, 11, 12));
  EXPECT_FALSE(end.verdict.trustworthy);

  ForcePoints wrong;
  Random random(5);
  for (int i = 0; i < 12; ++i) {
    wrong.counts.push_back(50.0 + 15.0 * i);
    wrong.force_N.push_back(0.02 * wrong.counts.back() - 1.0 + 0.01 * random.normal());
  }
  wrong.force_N[4] += 0.5;
  EXPECT_THAT(fit_force_line(wrong).outliers, ElementsAre(4));
}

TEST(FitForceLine, RefusesWhatDeterminesNoLine) {
  EXPECT_THAT(message_of([] { fit_force_line({{1, 2}, {1, 2}}); }), HasSubstr("five or more forces"));
  EXPECT_THAT(message_of([] { fit_force_line({{7, 7, 7, 7}, {1, 2, 3, 4}}); }), HasSubstr("all counts are 7"));
  EXPECT_THAT(message_of([] { fit_force_line({{1, 2, 3, 4}, {2, 2, 2, 2}}); }), HasSubstr("all forces are 2"));
  EXPECT_THAT(message_of([] { fit_force_line({{1, 2, 3}, {1, 2, std::nan("")}}); }), HasSubstr("not finite"));
}

TEST(FitForceLine, ThreePointsAreNotTrusted) {
  const ForceLineFit fit = fit_force_line({{50, 100, 150}, {0.0, 1.1, 1.9}});
  EXPECT_EQ(fit.degrees_of_freedom, 1);
  EXPECT_FALSE(fit.verdict.trustworthy);
}

// Six readings each of 0 and 3 N: nothing is seen between them.
TEST(FitForceLine, TwoLoadsCannotShowStraightness) {
  ForcePoints two;
  for (int i = 0; i < 6; ++i) {
    two.counts.insert(two.counts.end(), {1000.0 + i % 2, 9000.0 - i % 3});
    two.force_N.insert(two.force_N.end(), {0.0, 3.0});
  }
  EXPECT_EQ(verdict_word(fit_force_line(two).verdict.verdicts), "limited");
  two.counts.push_back(5000.0);
  two.force_N.push_back(1.5);
  EXPECT_EQ(fit_force_line(two).loads, 3u);
  EXPECT_EQ(verdict_word(fit_force_line(two).verdict.verdicts), "valid");
}

// Counts 0, 100, 200 at 0, 1, 2 N: x̄ = 100, Sxx = 20000. A uniform error of ±½ count is 0.01/√12 N.
TEST(FitForceLine, RoundingIsPartOfTheStandardErrors) {
  const ForceLineFit fit = fit_force_line({{0, 100, 200}, {0, 1, 2}});
  const double rounding_N = 0.01 / std::sqrt(12.0);
  EXPECT_NEAR(fit.newton_per_count_stderr, rounding_N / std::sqrt(20000.0), 1e-12);
  EXPECT_NEAR(fit.offset_newton_stderr, rounding_N * std::sqrt(1.0 / 3.0 + 100.0 * 100.0 / 20000.0), 1e-12);
}

TEST(ReadForcePoints, RefusesForcesThatNoHandGives) {
  const testkit::TempDir dir;
  const auto file = dir.path() / "grams.csv";
  std::ofstream(file) << "counts,force_N\n1667,20.4\n3121,64.9\n4576,109.35\n";
  EXPECT_THAT(message_of([&] { read_force_points(file); }),
              testing::AllOf(HasSubstr("grams.csv:4: column 'force_N': '109.35'"), HasSubstr("grams")));
}

TEST(ReadForcePoints, NamesTheFaultyCell) {
  const testkit::TempDir dir;
  const auto file = dir.path() / "force.csv";
  const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
  write("counts,force_N,comment\n48,0,a\n95,1.14,b\n");
  EXPECT_THAT(read_force_points(file).counts, ElementsAre(48, 95));
  write("counts,force_N\n48,0\n95,inf\n");
  EXPECT_THAT(message_of([&] { read_force_points(file); }), HasSubstr("force.csv:3: column 'force_N'"));
  write("counts,newton\n48,0\n");
  EXPECT_THAT(message_of([&] { read_force_points(file); }), HasSubstr("force_N"));
}

}  // namespace
}  // namespace asperity
