#include "draw_profiles.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "asperity/signal/spectrum.h"

namespace bench {

using asperity::Random;

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

double exponential(Random& random) { return -std::log(1.0 - random.uniform()); }

}  // namespace

double log_uniform(Random& random, double low, double high) {
  return low * std::exp(random.uniform() * std::log(high / low));
}

std::vector<double> scaled(std::vector<double> x, double rms) {
  double mean = 0.0, square = 0.0;
  for (const double v : x) mean += v / static_cast<double>(x.size());
  for (double& v : x) v -= mean;
  for (const double v : x) square += v * v / static_cast<double>(x.size());
  for (double& v : x) v *= rms / std::sqrt(square);
  return x;
}

namespace {

// Gaussian, of the density `psd` over cycles/mm, through a high-pass at 0.1 cycles/mm as a texture has it. Cut out of
// twice its length: the transform's own period must not show.
std::vector<double> draw_gaussian(const std::function<double(double)>& psd, std::size_t points, Random& random) {
  std::size_t n = 16;
  while (n < 2 * points) n *= 2;
  std::vector<std::complex<double>> half(n / 2 + 1, 0.0);
  for (std::size_t k = 1; k + 1 < half.size(); ++k) {
    const double f = static_cast<double>(k) / (static_cast<double>(n) * kProfileSpacing_mm);
    const double high_pass = 1.0 / (1.0 + 0.414 * std::pow(0.1 / f, 4.0));
    const double real = random.normal(), imaginary = random.normal();
    half[k] = high_pass * std::sqrt(psd(f)) * std::complex<double>(real, imaginary);
  }
  std::vector<double> out = asperity::inverse_real_dft(half, n);
  out.resize(points);
  return scaled(std::move(out), kProfileRq_m);
}

std::vector<double> draw_peak(double width, double floor, std::size_t points, Random& random) {
  const double centre = log_uniform(random, 0.2, 3.0);
  return draw_gaussian([&](double f) { return floor + std::exp(-0.5 * std::pow((f / centre - 1.0) / width, 2.0)); },
                       points, random);
}

std::vector<double> draw_band(double floor, std::size_t points, Random& random) {
  const double low = log_uniform(random, 0.1, 1.0), high = log_uniform(random, 1.5, 8.0);
  return draw_gaussian([&](double f) { return f > low && f < high ? 1.0 : floor; }, points, random);
}

std::vector<double> draw_fractal(double slope, std::size_t points, Random& random) {
  return draw_gaussian([&](double f) { return std::pow(f, -slope); }, points, random);
}

// Straight from one random height to the next, at random places.
std::vector<double> draw_facets(std::size_t points, Random& random) {
  const double mean_mm = log_uniform(random, 0.15, 1.5);
  double from_mm = 0.0, to_mm = mean_mm * exponential(random), low = random.normal(), high = random.normal();
  std::vector<double> out(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double at_mm = static_cast<double>(i) * kProfileSpacing_mm;
    while (at_mm > to_mm) {
      from_mm = to_mm;
      to_mm += mean_mm * exponential(random);
      low = high;
      high = random.normal();
    }
    out[i] = low + (high - low) * (at_mm - from_mm) / (to_mm - from_mm);
  }
  return scaled(std::move(out), kProfileRq_m);
}

// Plateaus 0.5 to 1.5 times a mean length long, joined by steep ramps.
std::vector<double> draw_plateaus(std::size_t points, Random& random) {
  const double mean_mm = random.uniform(1.0, 3.0), ramp_mm = 0.2;
  double to_mm = mean_mm * random.uniform(0.5, 1.5), low = random.normal(), high = random.normal();
  std::vector<double> out(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double at_mm = static_cast<double>(i) * kProfileSpacing_mm;
    while (at_mm > to_mm + ramp_mm) {
      to_mm += ramp_mm + mean_mm * random.uniform(0.5, 1.5);
      low = high;
      high = random.normal();
    }
    out[i] = low + (high - low) * std::clamp((at_mm - to_mm) / ramp_mm, 0.0, 1.0);
  }
  return scaled(std::move(out), kProfileRq_m);
}

// A relief of so many plane waves in random directions, as simulators make it: lines, each with that part of the power.
std::vector<double> draw_waves(int waves, std::size_t points, Random& random) {
  std::vector<double> out(points, 0.0);
  for (int w = 0; w < waves; ++w) {
    const double f = 0.25 * std::pow(10.0, (w + random.uniform()) / waves) * std::cos(kTwoPi * random.uniform());
    const double phase = kTwoPi * random.uniform();
    for (std::size_t i = 0; i < points; ++i)
      out[i] += std::cos(kTwoPi * f * kProfileSpacing_mm * static_cast<double>(i) + phase);
  }
  return scaled(std::move(out), kProfileRq_m);
}

std::vector<double> with_gaps(std::vector<double> x, Random& random) {
  const int count = 1 + static_cast<int>(3.0 * random.uniform());
  for (int k = 0; k < count; ++k) {
    const auto n = static_cast<double>(x.size());
    const auto length = static_cast<std::size_t>(n * random.uniform(0.01, 0.15));
    const auto from = static_cast<std::size_t>(random.uniform() * static_cast<double>(x.size() - length));
    std::fill_n(x.begin() + static_cast<std::ptrdiff_t>(from), length, std::numeric_limits<double>::quiet_NaN());
  }
  return x;
}

}  // namespace

const std::vector<ProfileFamily>& random_families() {
  static const std::vector<ProfileFamily> families{
      {"white", [](auto n, Random& r) { return draw_gaussian([](double) { return 1.0; }, n, r); }},
      {"white, a band with sharp edges", [](auto n, Random& r) { return draw_band(0.0, n, r); }},
      {"the same with gaps", [](auto n, Random& r) { return with_gaps(draw_band(1e-3, n, r), r); }},
      {"f^−1", [](auto n, Random& r) { return draw_fractal(1.0, n, r); }},
      {"f^−2", [](auto n, Random& r) { return draw_fractal(2.0, n, r); }},
      {"f^−3", [](auto n, Random& r) { return draw_fractal(3.0, n, r); }},
      {"f^−3 with gaps", [](auto n, Random& r) { return with_gaps(draw_fractal(3.0, n, r), r); }},
      {"f^−4", [](auto n, Random& r) { return draw_fractal(4.0, n, r); }},
      {"a peak of relative width 5 %", [](auto n, Random& r) { return draw_peak(0.05, 0.0, n, r); }},
      {"a peak of 5 % over a floor", [](auto n, Random& r) { return draw_peak(0.05, 0.01, n, r); }},
      {"a peak of 10 %", [](auto n, Random& r) { return draw_peak(0.1, 1e-3, n, r); }},
      {"a peak of 10 % with gaps", [](auto n, Random& r) { return with_gaps(draw_peak(0.1, 1e-3, n, r), r); }},
      {"a peak of 20 %", [](auto n, Random& r) { return draw_peak(0.2, 1e-3, n, r); }},
      {"a peak of 50 %", [](auto n, Random& r) { return draw_peak(0.5, 1e-3, n, r); }},
      {"facets", [](auto n, Random& r) { return draw_facets(n, r); }},
      {"plateaus", [](auto n, Random& r) { return draw_plateaus(n, r); }},
      {"300 plane waves", [](auto n, Random& r) { return draw_waves(300, n, r); }},
      {"160 plane waves", [](auto n, Random& r) { return draw_waves(160, n, r); }},
  };
  return families;
}

double shape_at(const std::string& shape, double u) {
  if (shape == "sine") return std::sin(kTwoPi * u);
  if (shape == "triangle") return u < 0.5 ? 4.0 * u - 1.0 : 3.0 - 4.0 * u;
  if (shape == "saw") return u < 0.75 ? u / 0.375 - 1.0 : 1.0 - (u - 0.75) / 0.125;
  return u < 0.45 ? -std::cos(kTwoPi * u / 0.45) : -1.0;  // ribs
}

std::vector<double> draw_pattern(const std::string& shape, double pitch_mm, double jitter, std::size_t points,
                                 Random& random) {
  double from_mm = -pitch_mm * random.uniform(), to_mm = from_mm + pitch_mm;
  std::vector<double> out(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double at_mm = static_cast<double>(i) * kProfileSpacing_mm;
    while (at_mm >= to_mm) {
      from_mm = to_mm;
      to_mm += pitch_mm * std::max(0.2, 1.0 + jitter * random.normal());
    }
    out[i] = shape_at(shape, (at_mm - from_mm) / (to_mm - from_mm));
  }
  return scaled(std::move(out), kProfileRq_m);
}

std::vector<Eigen::Vector2d> draw_arc(double sagitta_mm, std::size_t points) {
  const double length_mm = kProfileSpacing_mm * static_cast<double>(points - 1);
  // sagitta = r (1 − cos(turn/2)), length = r turn.
  double low = 1e-6, high = std::numbers::pi;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    ((1.0 - std::cos(0.5 * middle)) / middle * length_mm < sagitta_mm ? low : high) = middle;
  }
  const double radius_mm = length_mm / low;
  std::vector<Eigen::Vector2d> out;
  for (std::size_t i = 0; i < points; ++i) {
    const double angle = kProfileSpacing_mm * static_cast<double>(i) / radius_mm - 0.5 * low;
    out.emplace_back(1e-3 * radius_mm * std::sin(angle), 1e-3 * radius_mm * std::cos(angle));
  }
  return out;
}

std::vector<double> draw_relief(double width, const std::vector<Eigen::Vector2d>& path_m, Random& random) {
  constexpr int kReliefWaves = 300;
  const double middle_per_m = 1e3 * log_uniform(random, 0.4, 2.0);
  std::vector<double> out(path_m.size(), 0.0);
  for (int w = 0; w < kReliefWaves; ++w) {
    const double per_m = middle_per_m * std::exp(width * random.uniform(-1.0, 1.0));
    const double way = kTwoPi * random.uniform(), phase = kTwoPi * random.uniform();
    const Eigen::Vector2d g(per_m * std::cos(way), per_m * std::sin(way));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += std::cos(kTwoPi * g.dot(path_m[i]) + phase);
  }
  return scaled(std::move(out), kProfileRq_m);
}

std::vector<double> draw_holes(double pitch_m, double turned_rad, const std::vector<Eigen::Vector2d>& path_m,
                               Random& random) {
  const double c = std::cos(turned_rad), s = std::sin(turned_rad);
  const double along_m = pitch_m * random.uniform(), across_m = pitch_m * random.uniform();
  std::vector<double> out;
  for (const Eigen::Vector2d& p_m : path_m) {
    const double x_m = c * p_m.x() + s * p_m.y() + along_m, y_m = c * p_m.y() - s * p_m.x() + across_m;
    const double r = std::hypot(std::remainder(x_m, pitch_m), std::remainder(y_m, pitch_m)) / (0.3 * pitch_m);
    out.push_back(r < 1.0 ? r * r - 1.0 : 0.0);
  }
  return scaled(std::move(out), kProfileRq_m);
}

}  // namespace bench
