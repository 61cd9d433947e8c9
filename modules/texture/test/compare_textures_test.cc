#include "asperity/texture/compare_textures.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

using std::numbers::pi;

constexpr double kSpacing_m = 0.025e-3;

// A coarse wave under a fine one, amplitudes in metres, pitches in mm.
ComparedSurface two_waves(double coarse_m, double coarse_mm, double fine_m, double fine_mm) {
  std::vector<double> z;
  for (int i = 0; i < 1600; ++i) {
    const double x = 0.025 * i;
    z.push_back(coarse_m * std::sin(2 * pi * x / coarse_mm) + fine_m * std::sin(2 * pi * x / fine_mm));
  }
  ComparedSurface surface;
  surface.spacing_m = kSpacing_m;
  surface.lines_m = {band_limited_heights(z, kSpacing_m)};
  surface.roughness["RSm_m"] = coarse_mm * 1e-3;
  surface.roughness_of_pieces["RSm_m"] = {std::vector<double>(4, coarse_mm * 1e-3)};
  return surface;
}

TEST(JustNoticeable, IsTheSeeds) {
  EXPECT_EQ(just_noticeable_percent(0.0), 3.0);
  EXPECT_EQ(just_noticeable_percent(250.0), 3.0);
  EXPECT_EQ(just_noticeable_percent(275.0), 10.5);
  EXPECT_EQ(just_noticeable_percent(300.0), 18.0);
  EXPECT_EQ(just_noticeable_percent(1000.0), 18.0);
}

TEST(CompareTextures, ATextureIsLikeItself) {
  const ComparedSurface a = two_waves(10e-6, 2.0, 5e-6, 0.125);
  const TextureComparison c = compare_textures(a, a);
  EXPECT_EQ(c.verdict, HandVerdict::kSame);
  for (const auto& band : c.bands) EXPECT_EQ(band.rms_m.percent, 0.0);
  EXPECT_EQ(c.bands.front().low_cycles_per_mm, 0.15);
  EXPECT_EQ(c.bands.back().high_cycles_per_mm, 12.8);
}

TEST(CompareTextures, HoldsEachBandAgainstItsOwnThreshold) {
  // At 50 mm/s a pitch of 2 mm is 25 Hz, noticed from 3 %; one of 0.125 mm is 400 Hz, noticed from 18 %.
  const ComparedSurface a = two_waves(10e-6, 2.0, 5e-6, 0.125);
  EXPECT_EQ(compare_textures(a, two_waves(10.2e-6, 2.0, 5e-6, 0.125)).verdict, HandVerdict::kSame);
  EXPECT_EQ(compare_textures(a, two_waves(10e-6, 2.0, 5.75e-6, 0.125)).verdict, HandVerdict::kSame);
  const TextureComparison coarse = compare_textures(a, two_waves(10.5e-6, 2.0, 5e-6, 0.125));
  EXPECT_EQ(coarse.verdict, HandVerdict::kNoticeable);
  const TextureComparison fine = compare_textures(a, two_waves(10e-6, 2.0, 6.1e-6, 0.125));
  EXPECT_EQ(fine.verdict, HandVerdict::kNoticeable);
  for (const auto& band : fine.bands) {
    const bool holds_fine = band.low_cycles_per_mm < 8.0 && band.high_cycles_per_mm > 8.0;
    if (band.is_compared) {
      EXPECT_EQ(band.rms_m.verdict == HandVerdict::kNoticeable, holds_fine) << band.low_cycles_per_mm;
    }
    if (holds_fine) {
      EXPECT_EQ(band.rms_m.jnd_percent, 18.0);
      EXPECT_NEAR(band.rms_m.percent, 22.0, 0.5);
      EXPECT_NEAR(band.rms_m.a, 5e-6 / std::sqrt(2.0), 0.1e-6);
    }
  }
  // Stroked at 20 mm/s the fine wave is 160 Hz, and 15 % of it are felt.
  CompareTexturesConfig slow;
  slow.speed_mps = 0.02;
  EXPECT_EQ(compare_textures(a, two_waves(10e-6, 2.0, 5.75e-6, 0.125), slow).verdict, HandVerdict::kNoticeable);
}

TEST(CompareTextures, NoticesAnotherPitch) {
  const ComparedSurface a = two_waves(10e-6, 2.0, 0.0, 1.0);
  const TextureComparison c = compare_textures(a, two_waves(10e-6, 2.1, 0.0, 1.0));
  EXPECT_EQ(c.roughness.at("RSm_m").verdict, HandVerdict::kNoticeable);
  EXPECT_NEAR(c.roughness.at("RSm_m").percent, 5.0, 1e-9);
  EXPECT_NEAR(c.frequency_per_mm.percent, 100.0 / 1.05 - 100.0, 1.0);
}

ComparedSurface random_surface(Random& random, double rms_m, std::size_t count) {
  std::vector<double> z;
  for (std::size_t n = 0; n < count; ++n) z.push_back(rms_m * random.normal());
  return {{band_limited_heights(z, kSpacing_m)}, kSpacing_m, {}, {}};
}

// Pieces of one random surface differ by chance alone: nine of ten and more of the intervals hold the difference, and
// no more than a few are noticeable. 60 draws of a probability of 5 % exceed 9 in one of a thousand cases.
TEST(CompareTextures, PiecesOfOneSurfaceAreNotNoticeable) {
  Random random(1);
  constexpr int kDraws = 60, kMostOutside = 9;
  int outside = 0, noticeable = 0;
  for (int i = 0; i < kDraws; ++i) {
    const ComparedSurface a = random_surface(random, 10e-6, 4000), b = random_surface(random, 10e-6, 4000);
    const TextureComparison c = compare_textures(a, b);
    const Difference& band = c.bands[2].rms_m;
    outside += std::abs(band.percent) > band.uncertainty_percent ? 1 : 0;
    noticeable += band.verdict == HandVerdict::kNoticeable ? 1 : 0;
    EXPECT_LT(band.uncertainty_percent, 60.0);
  }
  EXPECT_LE(outside, kMostOutside);
  EXPECT_LE(noticeable, kMostOutside);
}

TEST(CompareTextures, ALargeDifferenceOfRandomSurfacesIsNoticeable) {
  Random random(2);
  const ComparedSurface a = random_surface(random, 10e-6, 4000), b = random_surface(random, 20e-6, 4000);
  EXPECT_EQ(compare_textures(a, b).verdict, HandVerdict::kNoticeable);
}

// Nanometres against nothing: below what any hand feels, so alike.
TEST(CompareTextures, WhatNoHandFeelsIsTheSame) {
  Random random(3);
  const ComparedSurface flat{{std::vector<double>(1600, 0.0)}, kSpacing_m, {{"Rq_m", 0.0}}, {}};
  ComparedSurface tiny = random_surface(random, 1e-9, 1600);
  tiny.roughness["Rq_m"] = 1e-9;
  EXPECT_EQ(compare_textures(tiny, flat).verdict, HandVerdict::kSame);
  EXPECT_EQ(compare_textures(flat, tiny).verdict, HandVerdict::kSame);
  EXPECT_EQ(compare_textures(flat, random_surface(random, 1e-6, 1600)).verdict, HandVerdict::kNoticeable);
}

// 2.5 mm hold 2 waves of 1.25 mm, 0.8 cycles/mm: the octaves from 0.15, 0.3 and 0.6 /mm are left out.
TEST(CompareTextures, LeavesOutOctavesThatALineIsTooShortFor) {
  Random random(4);
  const TextureComparison c = compare_textures(random_surface(random, 1e-6, 100), random_surface(random, 1e-6, 4000));
  for (const BandDifference& band : c.bands) EXPECT_EQ(band.is_resolved, band.low_cycles_per_mm > 0.8);
  EXPECT_NE(c.verdict, HandVerdict::kNoticeable);  // of one surface, 2.5 mm of which decide nothing
}

// Rsk has no threshold: it carries no verdict, and its difference is stated.
TEST(CompareTextures, ShapesOfHillsAreStatedAndNotJudged) {
  ComparedSurface a = two_waves(10e-6, 2.0, 5e-6, 0.125), b = a;
  b.lines_m[0][0] += 1e-12;  // other numbers
  a.roughness["Rsk"] = -2.0;
  b.roughness["Rsk"] = 2.0;
  a.roughness_of_pieces["Rsk"] = {{-2.1, -1.9, -2.0, -2.0}};
  b.roughness_of_pieces["Rsk"] = {{2.1, 2.0, 2.0, 1.9}};
  const TextureComparison c = compare_textures(a, b);
  EXPECT_TRUE(c.other_shape);
  EXPECT_TRUE(std::isnan(c.roughness.at("Rsk").jnd_percent));
  EXPECT_EQ(c.verdict, HandVerdict::kSame);
}

TEST(CompareTextures, RefusesWhatCannotBeCompared) {
  const ComparedSurface a = two_waves(1e-6, 2.0, 0.0, 1.0);
  EXPECT_THROW(compare_textures(a, {}), Error);
  EXPECT_THROW(compare_textures(a, {{{1.0, 2.0}}, kSpacing_m, {}, {}}), Error);
  EXPECT_THROW(band_limited_heights({}, kSpacing_m), Error);
  EXPECT_THROW(band_limited_heights(std::vector<double>(100, std::numeric_limits<double>::quiet_NaN()), kSpacing_m),
               Error);
  EXPECT_THROW(band_limited_heights(std::vector<double>(100, 0.0), 10e-3), Error);
}

}  // namespace
}  // namespace asperity
