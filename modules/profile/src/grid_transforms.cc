#include "grid_transforms.h"

#include <algorithm>
#include <complex>

#include "asperity/signal/spectrum.h"

namespace asperity {
namespace {

using Complex = std::complex<double>;

// The transforms of rows, each half of its length: those of real numbers are symmetric.
struct HalfSpectra {
  std::size_t width = 0, rows = 0;
  std::vector<Complex> values;
};

// Rows of zeros follow up to `least_rows`.
HalfSpectra transform_rows(std::size_t columns, std::size_t rows, std::size_t least_rows, std::size_t padded,
                           const GridRow& row_of) {
  const std::size_t width = padded / 2 + 1, all_rows = std::max(rows, least_rows);
  HalfSpectra out{width, all_rows, std::vector<Complex>(width * all_rows)};
  std::vector<double> line(padded, 0.0);
  for (std::size_t row = 0; row < rows; ++row) {
    row_of(row, std::span(line).first(columns));
    const std::vector<Complex> half = real_dft(line);
    std::copy(half.begin(), half.end(), &out.values[row * out.width]);
  }
  return out;
}

// `work` makes of each column, zeros after its end up to `padded`, another: what it returns takes the place of the
// column's first values. Columns are taken out some at a time, so that what is read of a row is read once.
template <class Work>
void change_columns(HalfSpectra& of, std::size_t padded, const Work& work) {
  constexpr std::size_t kTogether = 8;
  std::vector<std::vector<Complex>> block(kTogether);
  for (std::size_t first = 0; first < of.width; first += kTogether) {
    const std::size_t count = std::min(kTogether, of.width - first);
    for (auto& column : block) column.assign(padded, Complex());
    for (std::size_t row = 0; row < of.rows; ++row)
      for (std::size_t c = 0; c < count; ++c) block[c][row] = of.values[row * of.width + first + c];
    for (std::size_t c = 0; c < count; ++c) block[c] = work(block[c]);
    const std::size_t changed = std::min(of.rows, block.front().size());
    for (std::size_t row = 0; row < changed; ++row)
      for (std::size_t c = 0; c < count; ++c) of.values[row * of.width + first + c] = block[c][row];
  }
}

// Room for lags of up to half of `n` and one, of an even length: those are transformed fastest.
std::size_t padded_length(std::size_t n) { return 2 * smooth_length((n + n / 2 + 2 + 1) / 2); }

}  // namespace

LagSums::LagSums(std::size_t columns, std::size_t rows, const GridRow& row_of) : reach_(columns / 2 + 1) {
  const std::size_t padded_columns = padded_length(columns), padded_rows = padded_length(rows);
  const std::size_t lag_rows = rows / 2 + 2, width = 2 * reach_ + 1;
  HalfSpectra grid = transform_rows(columns, rows, lag_rows, padded_columns, row_of);
  std::vector<double> power(padded_rows);
  change_columns(grid, padded_rows, [&](const std::vector<Complex>& column) {
    const std::vector<Complex> spectrum = complex_dft(column);
    for (std::size_t k = 0; k < padded_rows; ++k) power[k] = std::norm(spectrum[k]) / static_cast<double>(padded_rows);
    // The inverse of real numbers is the conjugate of their transform.
    std::vector<Complex> lags = real_dft(power);
    for (Complex& lag : lags) lag = std::conj(lag);
    return lags;
  });
  sums_.resize(lag_rows * width);
  for (std::size_t dy = 0; dy < lag_rows; ++dy) {
    const std::vector<double> line =
        inverse_real_dft(std::span(grid.values).subspan(dy * grid.width, grid.width), padded_columns);
    for (std::size_t k = 0; k < width; ++k)
      sums_[dy * width + k] = line[(padded_columns + k - reach_) % padded_columns];
  }
}

std::vector<double> grid_power(std::size_t columns, std::size_t rows, const GridRow& row_of) {
  HalfSpectra grid = transform_rows(columns, rows, 0, columns, row_of);
  change_columns(grid, rows, [](const std::vector<Complex>& column) { return complex_dft(column); });
  std::vector<double> out(grid.values.size());
  std::transform(grid.values.begin(), grid.values.end(), out.begin(), [](Complex x) { return std::norm(x); });
  return out;
}

}  // namespace asperity
