#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/simulation_config.h"

namespace asperity {
namespace {

SimulatedSurfaceConfig config_of(const char* name) { return make_simulation_config(name, "open").surface; }

std::vector<double> line(const Surface& surface, double length_m, double spacing_m, double across_m) {
  std::vector<double> out;
  for (double x = 0.0; x < length_m; x += spacing_m) out.push_back(surface.height_m(x, across_m));
  return out;
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// Share of a line's power between two frequencies, by the plain discrete Fourier sum.
double power_share(const std::vector<double>& h, double spacing_mm, double low_per_mm, double high_per_mm) {
  const double length_mm = spacing_mm * static_cast<double>(h.size());
  double inside = 0.0;
  for (int k = static_cast<int>(std::ceil(low_per_mm * length_mm)); k / length_mm < high_per_mm; ++k) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < h.size(); ++i) {
      sum +=
          h[i] * std::polar(1.0, -2.0 * std::numbers::pi * k * static_cast<double>(i) / static_cast<double>(h.size()));
    }
    inside += 2.0 * std::norm(sum);
  }
  const double n = static_cast<double>(h.size());
  return inside / (n * n) / (rms(h) * rms(h));
}

double mean_square_slope(const std::vector<double>& h, double spacing_m) {
  double sum = 0.0;
  for (std::size_t i = 1; i < h.size(); ++i) sum += std::pow((h[i] - h[i - 1]) / spacing_m, 2);
  return sum / static_cast<double>(h.size() - 1);
}

TEST(MakeSurface, SineHasItsAmplitudeAndPitch) {
  const auto surface = make_surface(config_of("sine"), 1);
  EXPECT_NEAR(surface->height_m(0.5e-3, 0.0), 0.1e-3, 1e-15);
  EXPECT_NEAR(surface->height_m(1.5e-3, 7e-3), -0.1e-3, 1e-15);
  EXPECT_NEAR(surface->height_m(2.0e-3, 0.0), 0.0, 1e-15);
}

TEST(MakeSurface, ProtoboardHasHolesOnALattice) {
  const auto surface = make_surface(config_of("protoboard"), 1);
  for (const double along_m : {-5.0e-3, 0.0, 2.5e-3, 40.0e-3}) {
    EXPECT_DOUBLE_EQ(surface->height_m(along_m, 0.0), -1.5e-3);
    EXPECT_DOUBLE_EQ(surface->height_m(along_m, 2.5e-3), -1.5e-3);
    EXPECT_DOUBLE_EQ(surface->height_m(along_m + 1.25e-3, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(surface->height_m(along_m, 1.25e-3), 0.0);
    EXPECT_NEAR(surface->height_m(along_m + 0.7e-3, 0.0), -0.75e-3, 1e-12);  // half-way up the funnel
  }
}

TEST(MakeSurface, CableTieRisesSlowlyAndFallsQuickly) {
  const auto surface = make_surface(config_of("cable_tie"), 1);
  EXPECT_DOUBLE_EQ(surface->height_m(0.0, 0.0), -0.4e-3);
  EXPECT_NEAR(surface->height_m(0.9e-3, 0.0), 0.0, 1e-15);
  EXPECT_NEAR(surface->height_m(1.05e-3, 0.0), -0.2e-3, 1e-12);
  EXPECT_NEAR(surface->height_m(-0.3e-3, 0.0), 0.0, 1e-12);
}

TEST(MakeSurface, StochasticReliefHasItsRoughnessBandAndSeed) {
  const auto sandpaper = make_surface(config_of("sandpaper"), 3);
  const auto pot = make_surface(config_of("clay_pot"), 3);
  constexpr double kSpacing_m = 0.1e-3;
  double sand_square = 0.0;
  double pot_square = 0.0;
  for (int row = 0; row < 20; ++row) {
    sand_square += std::pow(rms(line(*sandpaper, 0.08, kSpacing_m, row * 11e-3)), 2) / 20;
    pot_square += std::pow(rms(line(*pot, 0.08, kSpacing_m, row * 11e-3)), 2) / 20;
  }
  EXPECT_NEAR(std::sqrt(sand_square), 40e-6, 2e-6);  // 1600 mm of line, some 600 independent bumps: 3 %
  EXPECT_NEAR(std::sqrt(pot_square), 25e-6, 1.2e-6);

  const std::vector<double> sand_line = line(*sandpaper, 0.08, kSpacing_m, 0.0);
  const std::vector<double> pot_line = line(*pot, 0.08, kSpacing_m, 0.0);
  // A line across a plane wave sees at most the wave's own frequency; leakage of the cut ends is the rest.
  EXPECT_LT(power_share(sand_line, 0.1, 2.6, 5.0), 0.01);
  EXPECT_GT(power_share(sand_line, 0.1, 0.1, 2.6), 0.9);
  EXPECT_LT(power_share(pot_line, 0.1, 3.1, 5.0), 0.01);
  // The pot has the smaller amplitude and the higher spatial frequency (seed §6.2).
  EXPECT_GT(mean_square_slope(pot_line, kSpacing_m) / (25e-6 * 25e-6),
            1.5 * mean_square_slope(sand_line, kSpacing_m) / (40e-6 * 40e-6));

  EXPECT_EQ(line(*make_surface(config_of("sandpaper"), 3), 0.01, kSpacing_m, 0.0),
            line(*sandpaper, 0.01, kSpacing_m, 0.0));
  EXPECT_NE(line(*make_surface(config_of("sandpaper"), 4), 0.01, kSpacing_m, 0.0),
            line(*sandpaper, 0.01, kSpacing_m, 0.0));
}

TEST(MakeSurface, RefusesWhatCannotBe) {
  SimulatedSurfaceConfig band = config_of("sandpaper");
  band.low_cycles_per_mm = 3.0;
  EXPECT_THROW(make_surface(band, 1), Error);
  SimulatedSurfaceConfig hole = config_of("protoboard");
  hole.hole_opening_diameter_m = 0.5e-3;
  EXPECT_THROW(make_surface(hole, 1), Error);
  EXPECT_THROW(make_simulation_config("velvet", "open"), Error);
  EXPECT_THROW(make_simulation_config("sine", "closed"), Error);
  EXPECT_THROW(make_simulation_config("sine", "open", "glass"), Error);
}

}  // namespace
}  // namespace asperity
