#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/texture/fit_areal.h"
#include "asperity/texture/spline_grid.h"

namespace asperity {

// Coefficients of `to` so that it runs near `from`: from's heights at to's grid points. Good as a start, no
// more.
void resample_grid(const SplineGrid& from, SplineGrid& to);

// The normal equations (BᵀB + λ DᵀD) c = Bᵀ(z − mean) of fit_areal, applied without a matrix.
class ArealSystem {
 public:
  ArealSystem(const SplineGrid& grid, std::span<const ArealSample> samples, double mean_m, double smoothness);

  // Conjugate gradients with a diagonal preconditioner from `c`; returns the relative residual reached.
  double solve(std::vector<double>& c, int iterations, double tolerance, const Observer& observer) const;

  // 1 where samples within one grid cell and a half weigh upon the coefficient.
  std::vector<std::uint8_t> supported() const;

 private:
  struct Row {
    std::array<std::uint32_t, 4> column;
    std::array<std::uint32_t, 4> row;
    std::array<double, 4> x;
    std::array<double, 4> y;
  };

  void apply(const std::vector<double>& c, std::vector<double>& out) const;

  std::size_t columns_;
  std::size_t rows_;
  bool periodic_;
  double lambda_;
  std::vector<Row> samples_;
  std::vector<double> right_;
  std::vector<double> weight_;    // Σ over samples of their spline's square: the diagonal of BᵀB
  std::vector<double> diagonal_;  // of the whole
};

}  // namespace asperity
