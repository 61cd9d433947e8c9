#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace asperity {

// Values between samples that come one by one: sum of x_i h(t − i) with h a windowed sinc (Kaiser, 70 dB): flat to
// 0.39 of the samples' rate, images suppressed from 0.53 of it on. It looks kAhead samples ahead, hence its delay.
class BandLimitedReader {
 public:
  static constexpr std::size_t kTaps = 32, kAhead = kTaps / 2;

  BandLimitedReader();

  void fill(double x) noexcept { window_.fill(x); }

  // The next sample; the place of fraction 0 moves on by one.
  void shift(double x) noexcept {
    newest_ = (newest_ + 1) % kTaps;
    window_[newest_] = x;
  }

  // At `fraction` in [0, 1) of the way from the sample kAhead behind the newest to the next.
  double at(double fraction) const noexcept;

 private:
  static constexpr std::size_t kPhases = 256;
  std::vector<std::array<double, kTaps>> kernel_;  // kPhases + 1 rows, each of sum 1
  std::array<double, kTaps> window_{};
  std::size_t newest_ = 0;
};

}  // namespace asperity
