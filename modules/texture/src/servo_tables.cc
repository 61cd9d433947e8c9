#include "asperity/texture/servo_tables.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <unsupported/Eigen/FFT>

namespace asperity {
namespace {

using Complex = std::complex<double>;

constexpr double kHeightBound = 1.0 / 10321920.0;
constexpr double kSlopeBound = 3.69e-7;
constexpr std::size_t kFewestCells = 4;

// The r-th derivative half a cell before each cell's middle, in units of cells, over r!: the coefficient of tʳ there.
std::vector<double> taylor_at_nodes(const Fourier1d& series, std::size_t cells, int r) {
  const double cell_rad = 2.0 * std::numbers::pi / static_cast<double>(cells);
  std::vector<Complex> spectrum(cells, 0.0);
  for (std::size_t j = 0; j < series.a_m.size(); ++j) {
    Complex amplitude(series.a_m[j], -series.b_m[j]);
    amplitude *= std::polar(1.0, -0.5 * static_cast<double>(j + 1) * cell_rad);
    for (int k = 1; k <= r; ++k) amplitude *= Complex(0.0, static_cast<double>(j + 1) * cell_rad / k);
    // Harmonics that the nodes cannot tell apart fall together: so do their samples.
    spectrum[(j + 1) % cells] += amplitude;
  }
  if (r == 0) spectrum[0] += series.mean_m;
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::Unscaled);
  std::vector<Complex> value;
  fft.inv(value, spectrum);
  std::vector<double> real(cells);
  for (std::size_t i = 0; i < cells; ++i) real[i] = value[i].real();
  return real;
}

// The polynomial of degree 7 with Taylor coefficients l at 0 and r at 1, about ½.
TableCell hermite(const std::array<double, 4>& l, const std::array<double, 4>& r) {
  // What the right end still lacks after the left end's cubic, height and derivatives over factorials.
  const double d0 = r[0] - (l[0] + l[1] + l[2] + l[3]);
  const double d1 = r[1] - (l[1] + 2.0 * l[2] + 3.0 * l[3]);
  const double d2 = r[2] - (l[2] + 3.0 * l[3]);
  const double d3 = r[3] - l[3];
  TableCell cell{{l[0], l[1], l[2], l[3],                         //
                  35.0 * d0 - 15.0 * d1 + 5.0 * d2 - d3,          //
                  -84.0 * d0 + 39.0 * d1 - 14.0 * d2 + 3.0 * d3,  //
                  70.0 * d0 - 34.0 * d1 + 13.0 * d2 - 3.0 * d3,   //
                  -20.0 * d0 + 10.0 * d1 - 4.0 * d2 + d3}};
  // Horner's scheme, once for each coefficient about ½.
  for (std::size_t k = 0; k < cell.c.size(); ++k) {
    for (std::size_t i = cell.c.size() - 1; i > k; --i) cell.c[i - 1] += 0.5 * cell.c[i];
  }
  return cell;
}

}  // namespace

PeriodicTable make_periodic_table(const Fourier1d& series, double height_tolerance_m, double slope_tolerance) {
  double eighth = 0.0;
  for (std::size_t j = 0; j < series.a_m.size(); ++j)
    eighth += std::pow(static_cast<double>(j + 1), 8) * std::hypot(series.a_m[j], series.b_m[j]);
  const double length_m = 1e-3 * series.length_mm;
  std::size_t cells = kFewestCells;
  const auto fits = [&] {
    const double theta = 2.0 * std::numbers::pi / static_cast<double>(cells);
    const double seventh_power = std::pow(theta, 7);
    return kHeightBound * theta * seventh_power * eighth <= 0.5 * height_tolerance_m &&
           kSlopeBound * seventh_power * eighth * (2.0 * std::numbers::pi / length_m) <= 0.5 * slope_tolerance;
  };
  while (!fits()) {
    cells *= 2;
    if (cells > kMostTableCells) return {};
  }
  std::array<std::vector<double>, 4> taylor;
  for (int r = 0; r < 4; ++r) taylor[static_cast<std::size_t>(r)] = taylor_at_nodes(series, cells, r);
  PeriodicTable table;
  table.cells_per_m = static_cast<double>(cells) / length_m;
  table.cells.resize(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const auto at = [&](std::size_t node) {
      return std::array<double, 4>{taylor[0][node], taylor[1][node], taylor[2][node], taylor[3][node]};
    };
    table.cells[i] = hermite(at(i), at((i + 1) % cells));
  }
  return table;
}

}  // namespace asperity
