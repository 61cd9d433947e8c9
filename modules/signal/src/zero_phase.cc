#include "asperity/signal/zero_phase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

using std::numbers::pi;

constexpr std::size_t kGroup = 4;  // sections run interleaved in one pass

// The last two values of a group's input and of each section's output, newest first.
struct GroupState {
  std::array<double, kGroup + 1> one{};
  std::array<double, kGroup + 1> two{};
};

// Filters n samples, `step` apart; out may be in. Direct form I, because its recursion waits for one
// product and one difference only; sections are interleaved so that their waits overlap.
template <std::size_t N>
void run_group(const Biquad* sections, GroupState& state, const double* in, double* out, std::ptrdiff_t n,
               std::ptrdiff_t step) {
  std::array<Biquad, N> s;
  std::array<double, N + 1> one, two;
  std::copy_n(sections, N, s.begin());
  std::copy_n(state.one.begin(), N + 1, one.begin());
  std::copy_n(state.two.begin(), N + 1, two.begin());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double x = in[i * step];
    for (std::size_t k = 0; k < N; ++k) {
      const double early = s[k].b0 * x + s[k].b1 * one[k] + s[k].b2 * two[k] - s[k].a2 * two[k + 1];
      const double y = early - s[k].a1 * one[k + 1];
      two[k] = one[k];
      one[k] = x;
      x = y;
    }
    two[N] = one[N];
    one[N] = x;
    out[i * step] = x;
  }
  std::copy_n(one.begin(), N + 1, state.one.begin());
  std::copy_n(two.begin(), N + 1, state.two.begin());
}

class Cascade {
 public:
  // In the steady state that a constant input `x0` has led to.
  Cascade(std::span<const Biquad> sections, double x0) : sections_(sections) {
    for (std::size_t first = 0; first < sections.size(); first += kGroup) {
      GroupState state;
      state.one[0] = state.two[0] = x0;
      for (std::size_t k = 0; k < std::min(kGroup, sections.size() - first); ++k) {
        const Biquad& s = sections[first + k];
        x0 *= (s.b0 + s.b1 + s.b2) / (1.0 + s.a1 + s.a2);
        state.one[k + 1] = state.two[k + 1] = x0;
      }
      states_.push_back(state);
    }
  }

  void run(const double* in, double* out, std::ptrdiff_t n, std::ptrdiff_t step) {
    for (std::size_t g = 0; g < states_.size(); ++g) {
      const Biquad* s = sections_.data() + g * kGroup;
      switch (std::min(kGroup, sections_.size() - g * kGroup)) {
        case 1:
          run_group<1>(s, states_[g], in, out, n, step);
          break;
        case 2:
          run_group<2>(s, states_[g], in, out, n, step);
          break;
        case 3:
          run_group<3>(s, states_[g], in, out, n, step);
          break;
        default:
          run_group<4>(s, states_[g], in, out, n, step);
          break;
      }
      in = out;
    }
  }

 private:
  std::span<const Biquad> sections_;
  std::vector<GroupState> states_;
};

// Samples until the slowest pole's transient is a thousandth; infinite for a pole on the unit circle.
double settling_samples(std::span<const Biquad> sections) {
  double radius = 0.0;
  for (const Biquad& s : sections) {
    const double quarter = 0.25 * s.a1 * s.a1 - s.a2;
    radius = std::max(radius, quarter < 0.0 ? std::sqrt(s.a2) : std::abs(0.5 * s.a1) + std::sqrt(quarter));
  }
  if (radius <= 0.0) return 0.0;
  return std::log(1e-3) / std::log(radius);
}

void check_finite(std::span<const double> x) {
  const auto bad = std::find_if(x.begin(), x.end(), [](double v) { return !std::isfinite(v); });
  if (bad != x.end()) {
    throw Error("zero-phase filter: sample " + std::to_string(bad - x.begin()) + " is " + number_text(*bad));
  }
}

// The cut-off of each pass, the ratio applied to the prewarped frequency so that it is exact.
double pass_cutoff(double cutoff, double rate, double ratio) {
  if (!(rate > 0.0 && cutoff > 0.0 && cutoff < 0.5 * rate)) {
    throw Error("cut-off " + number_text(cutoff) + " must lie between 0 and half the sampling rate " +
                number_text(rate));
  }
  return std::atan(ratio * std::tan(pi * cutoff / rate)) * rate / pi;
}

}  // namespace

std::vector<double> zero_phase_filter(std::span<const double> x, std::span<const Biquad> sections) {
  std::vector<double> y(x.size());
  if (x.empty()) return y;
  if (sections.empty()) {
    check_finite(x);
    std::copy(x.begin(), x.end(), y.begin());
    return y;
  }

  const std::size_t n = x.size();
  const double wanted = std::max(6.0 * static_cast<double>(sections.size()) + 3.0, settling_samples(sections));
  const std::size_t pad = wanted < static_cast<double>(n - 1) ? static_cast<std::size_t>(std::ceil(wanted)) : n - 1;
  std::vector<double> left(pad), right(pad);
  for (std::size_t i = 0; i < pad; ++i) {
    left[i] = 2.0 * x[0] - x[pad - i];
    right[i] = 2.0 * x[n - 1] - x[n - 2 - i];
  }

  const auto count = static_cast<std::ptrdiff_t>(n);
  const auto margin = static_cast<std::ptrdiff_t>(pad);
  Cascade forward(sections, pad > 0 ? left.front() : x[0]);
  forward.run(left.data(), left.data(), margin, 1);
  forward.run(x.data(), y.data(), count, 1);
  // A value that is not finite stays in the recursion for ever, so looking at its last one is enough.
  if (!std::isfinite(y.back())) check_finite(x);
  forward.run(right.data(), right.data(), margin, 1);

  Cascade backward(sections, pad > 0 ? right.back() : y.back());
  if (pad > 0) backward.run(&right.back(), &right.back(), margin, -1);
  backward.run(&y.back(), &y.back(), count, -1);
  return y;
}

double zero_phase_corner_ratio(int order) {
  return std::pow(std::numbers::sqrt2 - 1.0, 0.5 / static_cast<double>(order));
}

std::vector<Biquad> zero_phase_highpass_pass(double cutoff, double rate, int order) {
  return butterworth_highpass(order, pass_cutoff(cutoff, rate, zero_phase_corner_ratio(order)), rate);
}

std::vector<Biquad> zero_phase_lowpass_pass(double cutoff, double rate, int order) {
  return butterworth_lowpass(order, pass_cutoff(cutoff, rate, 1.0 / zero_phase_corner_ratio(order)), rate);
}

std::vector<Biquad> zero_phase_bandpass_pass(double low, double high, double rate, int order) {
  if (!(rate > 0.0 && low > 0.0 && low < high && high < 0.5 * rate)) {
    throw Error("band " + number_text(low) + " to " + number_text(high) +
                " must rise and lie between 0 and half the sampling rate " + number_text(rate));
  }
  // The pass keeps the band's centre and is wider by the ratio of the low-pass prototype.
  const double w_low = std::tan(pi * low / rate);
  const double w_high = std::tan(pi * high / rate);
  const double half_width = 0.5 * (w_high - w_low) / zero_phase_corner_ratio(order);
  const double pass_high = half_width + std::hypot(half_width, std::sqrt(w_low * w_high));
  const double pass_low = w_low * w_high / pass_high;
  return butterworth_bandpass(order, std::atan(pass_low) * rate / pi, std::atan(pass_high) * rate / pi, rate);
}

std::vector<double> zero_phase_highpass(std::span<const double> x, double cutoff, double rate, int order) {
  return zero_phase_filter(x, zero_phase_highpass_pass(cutoff, rate, order));
}

std::vector<double> zero_phase_lowpass(std::span<const double> x, double cutoff, double rate, int order) {
  return zero_phase_filter(x, zero_phase_lowpass_pass(cutoff, rate, order));
}

std::vector<double> zero_phase_bandpass(std::span<const double> x, double low, double high, double rate, int order) {
  return zero_phase_filter(x, zero_phase_bandpass_pass(low, high, rate, order));
}

}  // namespace asperity
