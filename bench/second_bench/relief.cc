#include "relief.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "noise_sources.h"

namespace second_bench {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

struct Grid {
  double dx_m, dy_m, x0_m, y0_m;
  std::size_t columns, rows;
  std::vector<double> z_m;

  double x(std::size_t c) const { return x0_m + static_cast<double>(c) * dx_m; }
  double y(std::size_t r) const { return y0_m + static_cast<double>(r) * dy_m; }
};

template <class F>
void fill(Grid& grid, F height) {
  for (std::size_t r = 0; r < grid.rows; ++r) {
    for (std::size_t c = 0; c < grid.columns; ++c) grid.z_m[r * grid.columns + c] = height(grid.x(c), grid.y(r));
  }
}

// Waves in random directions whose wave numbers have the density k^-slope between the two cut-offs.
void add_random_field(Grid& grid, const ScanPlan& plan, Dice& dice) {
  constexpr int kWaves = 160;
  const double amplitude = plan.height_m * std::sqrt(2.0 / kWaves);
  for (int w = 0; w < kWaves; ++w) {
    const double u = (w + dice.uniform()) / kWaves, p = 1.0 - plan.slope;
    const double low = plan.low_cycles_per_mm, high = plan.high_cycles_per_mm;
    const double k = std::abs(p) < 1e-6
                         ? low * std::pow(high / low, u)
                         : std::pow(std::pow(low, p) + u * (std::pow(high, p) - std::pow(low, p)), 1.0 / p);
    const double direction = kTwoPi * dice.uniform(), phase = kTwoPi * dice.uniform();
    const double kx = kTwoPi * 1e3 * k * std::cos(direction), ky = kTwoPi * 1e3 * k * std::sin(direction);
    const std::complex<double> turn = std::polar(1.0, kx * grid.dx_m);
    for (std::size_t r = 0; r < grid.rows; ++r) {
      std::complex<double> z = std::polar(amplitude, phase + kx * grid.x0_m + ky * grid.y(r));
      double* row = grid.z_m.data() + r * grid.columns;
      for (std::size_t c = 0; c < grid.columns; ++c) {
        row[c] += z.real();
        z *= turn;
      }
    }
  }
}

void fill_sum_of_sines(Grid& grid, const ScanPlan& plan, Dice& dice) {
  const int count = 3 + dice.below(4);
  for (int k = 0; k < count; ++k) {
    const double cycles = kTwoPi * 1e3 * dice.log_uniform(plan.low_cycles_per_mm, plan.high_cycles_per_mm);
    const double phase = kTwoPi * dice.uniform(), skew = 0.2 * dice.normal();
    const double amplitude = plan.height_m * std::sqrt(2.0 / count);
    for (std::size_t r = 0; r < grid.rows; ++r) {
      for (std::size_t c = 0; c < grid.columns; ++c)
        grid.z_m[r * grid.columns + c] += amplitude * std::sin(cycles * (grid.x(c) + skew * grid.y(r)) + phase);
    }
  }
}

// Plateaus of random length and height, joined by rounded ramps.
void fill_steps(Grid& grid, const ScanPlan& plan, Dice& dice) {
  std::vector<double> row(grid.columns);
  double level_m = 0.0, next_m = 0.0, from_m = grid.x0_m, ramp_m = 0.2e-3;
  double to_m = from_m + plan.pitch_m * dice.uniform(0.5, 1.5);
  for (std::size_t c = 0; c < grid.columns; ++c) {
    if (grid.x(c) > to_m + ramp_m) {
      level_m = next_m;
      from_m = to_m + ramp_m;
      to_m = from_m + plan.pitch_m * dice.uniform(0.4, 1.6);
      ramp_m = dice.uniform(0.1e-3, 0.4e-3);
    }
    if (from_m <= to_m && next_m == level_m) next_m = plan.height_m * dice.normal();
    const double u = std::clamp((grid.x(c) - to_m) / ramp_m, 0.0, 1.0);
    row[c] = level_m + (next_m - level_m) * u * u * (3.0 - 2.0 * u);
  }
  for (std::size_t r = 0; r < grid.rows; ++r)
    std::copy(row.begin(), row.end(), grid.z_m.begin() + static_cast<std::ptrdiff_t>(r * grid.columns));
}

double ridge_m(double x_m, const ScanPlan& plan) {
  // A raised cosine over 45 % of the pitch, flat between.
  const double u = x_m / plan.pitch_m - std::floor(x_m / plan.pitch_m);
  return u < 0.45 ? 0.5 * plan.height_m * (1.0 - std::cos(kTwoPi * u / 0.45)) : 0.0;
}

double hole_m(double x_m, double y_m, const ScanPlan& plan) {
  // Dishes with a smooth rim, on a square lattice of which the path meets a row nearly through the middle.
  const auto off = [&](double v) { return v - plan.pitch_m * std::round(v / plan.pitch_m); };
  const double r = std::hypot(off(x_m), off(y_m + 0.05 * plan.pitch_m)) / (0.36 * plan.pitch_m);
  return r < 1.0 ? -plan.height_m * (1.0 - r * r) * (1.0 - r * r) : 0.0;
}

void fill_relief(Grid& grid, const ScanPlan& plan) {
  Dice dice(plan.seed, 11);
  const std::string& f = plan.family;
  if (f == "sine") {
    fill(grid, [&](double x, double) { return plan.height_m * std::sin(kTwoPi * x / plan.pitch_m); });
  } else if (f == "sines") {
    fill_sum_of_sines(grid, plan, dice);
  } else if (f == "ridges") {
    fill(grid, [&](double x, double) { return ridge_m(x, plan); });
  } else if (f == "holes") {
    fill(grid, [&](double x, double y) { return hole_m(x, y, plan); });
  } else if (f == "steps") {
    fill_steps(grid, plan, dice);
  } else if (f != "air") {
    add_random_field(grid, plan, dice);
  }
}

}  // namespace

RollingTip::RollingTip(const ScanPlan& plan, double margin_m, double half_width_m) : dx_m_(12e-6), dy_m_(40e-6) {
  const double r_m = plan.tip_radius_m;
  const auto reach_y = static_cast<std::ptrdiff_t>(std::ceil(r_m / dy_m_));
  const auto reach_x = static_cast<std::ptrdiff_t>(std::ceil(r_m / dx_m_));
  Grid grid;
  grid.dx_m = dx_m_;
  grid.dy_m = dy_m_;
  const auto half_rows = static_cast<std::ptrdiff_t>(std::ceil(half_width_m / dy_m_)) + 1;
  columns_ = static_cast<std::ptrdiff_t>(std::ceil((plan.length_m + 2.0 * margin_m) / dx_m_));
  rows_ = 2 * half_rows + 1;
  grid.columns = static_cast<std::size_t>(columns_ + 2 * reach_x);
  grid.rows = static_cast<std::size_t>(rows_ + 2 * reach_y);
  x0_m_ = -margin_m;
  y0_m_ = -static_cast<double>(half_rows) * dy_m_;
  grid.x0_m = x0_m_ - static_cast<double>(reach_x) * dx_m_;
  grid.y0_m = y0_m_ - static_cast<double>(reach_y) * dy_m_;
  grid.z_m.assign(grid.columns * grid.rows, 0.0);
  fill_relief(grid, plan);

  // How far the ball can reach sideways is bounded by the relief's height.
  const auto [lowest, highest] = std::minmax_element(grid.z_m.begin(), grid.z_m.end());
  const double range_m = *highest - *lowest;
  struct Offset {
    std::ptrdiff_t by;
    double cap_m;
  };
  std::vector<Offset> ball;
  for (std::ptrdiff_t j = -reach_y; j <= reach_y; ++j) {
    for (std::ptrdiff_t i = -reach_x; i <= reach_x; ++i) {
      const double square = std::pow(static_cast<double>(i) * dx_m_, 2) + std::pow(static_cast<double>(j) * dy_m_, 2);
      if (square >= r_m * r_m) continue;
      const double cap_m = std::sqrt(r_m * r_m - square) - r_m;
      if (-cap_m <= range_m) ball.push_back({j * static_cast<std::ptrdiff_t>(grid.columns) + i, cap_m});
    }
  }
  z_m_.resize(static_cast<std::size_t>(columns_ * rows_));
  for (std::ptrdiff_t j = 0; j < rows_; ++j) {
    double* out = z_m_.data() + j * columns_;
    const double* in = grid.z_m.data() + (j + reach_y) * static_cast<std::ptrdiff_t>(grid.columns) + reach_x;
    std::copy(in, in + columns_, out);
    for (const Offset& o : ball) {
      const double* shifted = in + o.by;
      for (std::ptrdiff_t i = 0; i < columns_; ++i) out[i] = std::max(out[i], shifted[i] + o.cap_m);
    }
  }
}

double RollingTip::node(std::ptrdiff_t column, std::ptrdiff_t row) const {
  return z_m_[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(row, 0, rows_ - 1) * columns_ +
                                       std::clamp<std::ptrdiff_t>(column, 0, columns_ - 1))];
}

RollingTip::Stand RollingTip::at(double x_m, double y_m) const {
  const double cx = (x_m - x0_m_) / dx_m_, cy = (y_m - y0_m_) / dy_m_;
  const auto column = static_cast<std::ptrdiff_t>(std::floor(cx));
  const auto row = static_cast<std::ptrdiff_t>(std::floor(cy));
  const double u = cx - static_cast<double>(column), v = cy - static_cast<double>(row);
  Stand out;
  for (std::ptrdiff_t j = 0; j < 2; ++j) {
    const double a = node(column - 1, row + j), b = node(column, row + j), c = node(column + 1, row + j),
                 d = node(column + 2, row + j);
    const double c1 = 0.5 * (c - a), c2 = a - 2.5 * b + 2.0 * c - 0.5 * d, c3 = 0.5 * (d - a) + 1.5 * (b - c);
    const double weight = j == 0 ? 1.0 - v : v;
    out.z_m += weight * (b + u * (c1 + u * (c2 + u * c3)));
    out.slope += weight * (c1 + u * (2.0 * c2 + 3.0 * u * c3)) / dx_m_;
  }
  return out;
}

}  // namespace second_bench
