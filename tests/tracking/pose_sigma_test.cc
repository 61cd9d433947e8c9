// The tracker's standard errors against its errors, where camera and body are not quite what it takes them for.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "sigma_cases.h"

namespace asperity {
namespace {

TEST(PoseSigma, ErrorsAreOfTheSizeThatIsStated) {
  const char* given = std::getenv("SIGMA_FRAMES");
  const int frames = given ? std::atoi(given) : 12;
  std::vector<double> pooled;
  for (const SigmaCase& one : sigma_cases()) {
    const SigmaRatios ratios = run_sigma_case(one, frames, 1);
    std::printf(
        "%-38s %3d of %3d: %.2f, axes %.2f %.2f %.2f  %.2f %.2f %.2f; over the frame's own %.2f; %.3f mm ± %.3f\n",
        one.name.c_str(), ratios.found, ratios.frames, ratios.pooled, ratios.rms[0], ratios.rms[1], ratios.rms[2],
        ratios.rms[3], ratios.rms[4], ratios.rms[5], ratios.noise_pooled, ratios.median_mm, ratios.median_sigma_mm);
    EXPECT_GE(ratios.found, frames * 9 / 10) << one.name;
    // Rendered tags are cleaner than the prior of what corners are off by: a moving body is stated worse than it is.
    EXPECT_GT(ratios.pooled, 0.4) << one.name;
    EXPECT_LT(ratios.pooled, 1.6) << one.name;
    pooled.push_back(ratios.pooled);
  }
  std::sort(pooled.begin(), pooled.end());
  const double median = 0.5 * (pooled[(pooled.size() - 1) / 2] + pooled[pooled.size() / 2]);
  EXPECT_GT(median, 0.8);
  EXPECT_LT(median, 1.25);
}

}  // namespace
}  // namespace asperity
