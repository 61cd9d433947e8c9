#include "asperity/texture/synthesize_isotropic.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <unsupported/Eigen/FFT>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

using Complex = std::complex<double>;

void check_spectrum(const IsotropicSpectrum& spectrum) {
  const std::size_t count = spectrum.power_m2.size();
  if (count == 0 || count > kMostIsotropicHarmonics) {
    throw Error("texture: an isotropic spectrum of " + std::to_string(count) + " harmonics; 1 to " +
                std::to_string(kMostIsotropicHarmonics) + " are possible");
  }
  if (!(spectrum.length_mm > 0.0) || !std::isfinite(spectrum.length_mm))
    throw Error("texture: the length " + number_text(spectrum.length_mm) + " mm is not positive");
  for (const double power : spectrum.power_m2) {
    if (!(power >= 0.0) || !std::isfinite(power))
      throw Error("texture: the power " + number_text(power) + " m² is negative or not a number");
  }
}

std::size_t ring(std::size_t m, std::size_t n) {
  return static_cast<std::size_t>(std::lround(std::hypot(static_cast<double>(m), static_cast<double>(n))));
}

// Inverse transforms of rows, then columns, unscaled.
void inverse_fft_2d(std::vector<Complex>& z, std::size_t n) {
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::Unscaled);
  std::vector<Complex> line(n), out(n);
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t step = pass == 0 ? 1 : n;
    const std::size_t stride = pass == 0 ? n : 1;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < n; ++k) line[k] = z[i * stride + k * step];
      fft.inv(out.data(), line.data(), static_cast<Eigen::Index>(n));
      for (std::size_t k = 0; k < n; ++k) z[i * stride + k * step] = out[k];
    }
  }
}

}  // namespace

SplineGrid synthesize_isotropic(const IsotropicSpectrum& spectrum) {
  check_spectrum(spectrum);
  const std::size_t most = spectrum.power_m2.size();
  std::size_t n = 8;
  while (n < 4 * most) n *= 2;
  // What a cubic B-spline's samples at the grid points do to a wave.
  const auto gain = [n](std::size_t k) {
    return (2.0 + std::cos(2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n))) / 3.0;
  };
  Random random(static_cast<std::uint64_t>(spectrum.seed));
  std::vector<Complex> z(n * n);
  z[0] = spectrum.mean_m;
  const auto put = [&](std::size_t column, std::size_t row, Complex value) {
    z[row * n + column] = value;
    z[((n - row) % n) * n + (n - column) % n] = std::conj(value);
  };
  for (std::size_t row = 0; row <= most; ++row) {
    for (std::size_t m = 0; m <= most; ++m) {
      const std::size_t j = ring(m, row);
      if (j == 0 || j > most) continue;
      const double amplitude = std::sqrt(spectrum.power_m2[j - 1]) / (gain(m) * gain(row));
      put(m, row, std::polar(amplitude, random.uniform(0.0, 2.0 * std::numbers::pi)));
      if (m > 0 && row > 0) put(n - m, row, std::polar(amplitude, random.uniform(0.0, 2.0 * std::numbers::pi)));
    }
  }
  inverse_fft_2d(z, n);
  SplineGrid grid;
  grid.columns = grid.rows = n;
  grid.spacing_x_m = grid.spacing_y_m = spectrum.length_mm * 1e-3 / static_cast<double>(n);
  grid.border = Border::kPeriodic;
  grid.coefficient_m.reserve(n * n);
  for (const Complex& value : z) grid.coefficient_m.push_back(value.real());
  return grid;
}

std::vector<double> section_power_m2(const IsotropicSpectrum& spectrum) {
  const std::size_t most = spectrum.power_m2.size();
  std::vector<double> section(most, 0.0);
  for (std::size_t m = 1; m <= most; ++m) {
    for (std::size_t n = 0; ring(m, n) <= most; ++n)
      section[m - 1] += (n == 0 ? 2.0 : 4.0) * spectrum.power_m2[ring(m, n) - 1];
  }
  return section;
}

}  // namespace asperity
