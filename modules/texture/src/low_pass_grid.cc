#include "low_pass_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>

#include <unsupported/Eigen/FFT>

#include "asperity/texture/low_pass_texture.h"

namespace asperity {
namespace {

using Complex = std::complex<double>;

// Where a line of `size` cells takes its value at `i`, beyond its ends too.
std::size_t continue_index(std::ptrdiff_t i, std::ptrdiff_t size, Border border) {
  if (border == Border::kClamp) return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, size - 1));
  const std::ptrdiff_t period = border == Border::kPeriodic ? size : 2 * (size - 1);
  const std::ptrdiff_t m = ((i % period) + period) % period;
  return static_cast<std::size_t>(m < size ? m : period - m);
}

// Filters lines of `size` values, two at a time as real and imaginary part: the gain is real and even, so that
// neither mixes with the other. Lines are continued by more than the filter's reach and to a power of two.
class LineFilter {
 public:
  LineFilter(std::size_t size, Border border, double cutoff) : size_(size) {
    constexpr double kReach = 12.0;  // waves of the cut-off; a step that far away is felt by 1e-3 of its height
    const auto most = static_cast<double>(4 * size);
    margin_ = static_cast<std::size_t>(std::ceil(std::min(kReach / cutoff, most)));
    const std::size_t length = std::bit_ceil(size + 2 * margin_);
    source_.resize(length);
    gain_.resize(length);
    for (std::size_t i = 0; i < length; ++i) {
      const auto at = static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(margin_);
      source_[i] = continue_index(at, static_cast<std::ptrdiff_t>(size), border);
      const std::size_t wave = std::min(i, length - i);
      gain_[i] = low_pass_gain(static_cast<double>(wave) / static_cast<double>(length), cutoff);
    }
    line_.resize(length);
  }

  template <class Value>
  void run(Value* first, Value* second, std::size_t stride) {
    for (std::size_t i = 0; i < line_.size(); ++i) {
      const std::size_t at = source_[i] * stride;
      line_[i] = Complex(static_cast<double>(first[at]), static_cast<double>(second[at]));
    }
    fft_.fwd(spectrum_, line_);
    for (std::size_t i = 0; i < spectrum_.size(); ++i) spectrum_[i] *= gain_[i];
    fft_.inv(line_, spectrum_);
    for (std::size_t i = 0; i < size_; ++i) {
      first[i * stride] = static_cast<Value>(line_[margin_ + i].real());
      second[i * stride] = static_cast<Value>(line_[margin_ + i].imag());
    }
  }

 private:
  std::size_t size_;
  std::size_t margin_ = 0;
  std::vector<std::size_t> source_;
  std::vector<double> gain_;
  std::vector<Complex> line_, spectrum_;
  Eigen::FFT<double> fft_;
};

// `count` lines, `apart` values from one to the next, `stride` from value to value.
template <class Value>
void filter_lines(std::vector<Value>& values, std::size_t size, std::size_t stride, std::size_t count,
                  std::size_t apart, Border border, double cutoff) {
  if (cutoff >= 1.0) return;  // all that cells can hold is below half of it
  LineFilter filter(size, border, cutoff);
  std::vector<Value> spare(size * stride);
  for (std::size_t line = 0; line < count; line += 2) {
    Value* first = values.data() + line * apart;
    filter.run(first, line + 1 < count ? first + apart : spare.data(), stride);
  }
}

template <class Value>
void filter_grid(std::vector<Value>& values, std::size_t columns, std::size_t rows, Border border, double cutoff_x,
                 double cutoff_y) {
  filter_lines(values, columns, 1, rows, columns, border, cutoff_x);
  filter_lines(values, rows, columns, columns, 1, border, cutoff_y);
}

}  // namespace

void low_pass_grid(std::vector<float>& values, std::size_t columns, std::size_t rows, Border border, double cutoff_x,
                   double cutoff_y) {
  filter_grid(values, columns, rows, border, cutoff_x, cutoff_y);
}

void low_pass_grid(std::vector<double>& values, std::size_t columns, std::size_t rows, Border border, double cutoff_x,
                   double cutoff_y) {
  filter_grid(values, columns, rows, border, cutoff_x, cutoff_y);
}

}  // namespace asperity
