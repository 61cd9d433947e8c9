#pragma once

#include <span>
#include <vector>

namespace asperity {

// The middle of a window of a vibration: the amplitude of the sine of the same power, and its frequency.
struct VibrationPoint {
  double t_s = 0.0;
  double amplitude = 0.0;     // √2 times the RMS, in the unit of the samples
  double frequency_Hz = 0.0;  // 0 where the window is silent
};

// Amplitude and frequency of a vibration in windows of `window_s` (a shorter rest belongs to the last one). The
// frequency is (rate/π) asin(½ √(Σ (a_i − a_{i−1})² / Σ a_i²)): exactly that of a sine over whole periods, and between
// the frequencies where there are several. The waveform and its phase are lost. Throws Error for a sample that is not
// finite, or a rate or window that is not positive.
std::vector<VibrationPoint> vibration_envelope(std::span<const double> samples, double rate_Hz, double window_s);

}  // namespace asperity
