#pragma once

#include <cmath>

#include "asperity/device/second_order_filter.h"

namespace asperity {

// Two bands of a force and their amplitudes: high-passed, then split in a slow and a fast part.
class RumbleBands {
 public:
  struct Amplitudes {
    double slow_N = 0.0, fast_N = 0.0;
  };

  RumbleBands(double high_pass_Hz, double split_Hz, double rate_Hz)
      : high_pass_(SecondOrderFilter::high_pass(high_pass_Hz, rate_Hz)),
        slow_(SecondOrderFilter::low_pass(split_Hz, rate_Hz)),
        fast_(SecondOrderFilter::high_pass(split_Hz, rate_Hz)) {}

  // The filters as if `force_N` had been there for ever: the first after a gap, whose step nobody felt.
  void start_at(double force_N) noexcept {
    high_pass_.start_high_pass_at(force_N);
    slow_.clear();
    fast_.clear();
  }

  void add(double force_N) noexcept {
    const double vibration_N = high_pass_(force_N);
    const double slow_N = slow_(vibration_N), fast_N = fast_(vibration_N);
    slow_sum_ += slow_N * slow_N;
    fast_sum_ += fast_N * fast_N;
    ++count_;
  }

  // √2 times the RMS of each band since the last call, 0 if nothing was added: a sine's amplitude.
  Amplitudes take() noexcept {
    if (count_ == 0) return {};
    const Amplitudes result{std::sqrt(2.0 * slow_sum_ / count_), std::sqrt(2.0 * fast_sum_ / count_)};
    slow_sum_ = fast_sum_ = 0.0;
    count_ = 0;
    return result;
  }

 private:
  SecondOrderFilter high_pass_, slow_, fast_;
  double slow_sum_ = 0.0, fast_sum_ = 0.0;
  int count_ = 0;
};

}  // namespace asperity
