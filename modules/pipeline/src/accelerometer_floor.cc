#include "asperity/pipeline/accelerometer_floor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "asperity/base/units.h"
#include "asperity/signal/spectrum.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr std::size_t kSegment = 1024;
constexpr std::size_t kFewest = 4 * kSegment;
constexpr double kHighest = 0.9;  // of the Nyquist frequency: beyond it converters have filters of their own
constexpr double kGone = 0.25;    // of the stated noise's density
constexpr double kLowest_Hz = 4.0;
constexpr double kRounding_counts2 = 1.0 / 12.0;

double median_between(const PowerSpectrum& spectrum, double low_Hz, double high_Hz) {
  std::vector<double> inside;
  for (std::size_t i = 0; i < spectrum.frequency.size(); ++i) {
    if (spectrum.frequency[i] >= low_Hz && spectrum.frequency[i] < high_Hz) inside.push_back(spectrum.density[i]);
  }
  return inside.empty() ? std::numeric_limits<double>::infinity() : median(inside);
}

}  // namespace

AccelerometerFloor accelerometer_floor(const Recording& recording) {
  AccelerometerFloor out;
  const ProbeStream& probe = recording.probe;
  const Eigen::Vector3d& stated_counts = recording.calibration.accelerometer.residual_counts;
  if (recording.calibration.uncalibrated || probe.size() < kFewest || !(stated_counts.minCoeff() > 0.0)) return out;
  const double span_s = static_cast<double>(probe.t_ns.back() - probe.t_ns.front()) * kNanosecond_s;
  if (!(span_s > 0.0)) return out;
  const double rate_Hz = static_cast<double>(probe.size() - 1) / span_s, nyquist_Hz = 0.5 * rate_Hz;
  std::vector<PowerSpectrum> spectra;
  bool whole = true;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> x;
    x.reserve(probe.size());
    for (const Eigen::Vector3d& counts : probe.accel_counts) {
      if (!std::isfinite(counts[axis])) continue;
      whole = whole && counts[axis] == std::round(counts[axis]);
      x.push_back(counts[axis]);
    }
    if (x.size() < kFewest) return out;
    spectra.push_back(welch(x, rate_Hz, kSegment));
    const double stated = stated_counts[axis] * stated_counts[axis] / nyquist_Hz;
    for (double& density : spectra.back().density) density /= stated;
  }
  const auto most_between = [&](double low_Hz, double high_Hz) {
    double most = 0.0;
    for (const PowerSpectrum& spectrum : spectra) most = std::max(most, median_between(spectrum, low_Hz, high_Hz));
    return most;
  };
  double low_Hz = 0.5 * nyquist_Hz;
  out.ratio = most_between(low_Hz, kHighest * nyquist_Hz);
  if (whole) out.rounding_ratio = 0.0;
  for (Eigen::Index axis = 0; whole && axis < 3; ++axis) {
    const double power_counts2 =
        median_between(spectra[static_cast<std::size_t>(axis)], low_Hz, kHighest * nyquist_Hz) * stated_counts[axis] *
        stated_counts[axis];
    out.rounding_ratio = std::max(out.rounding_ratio, power_counts2 / kRounding_counts2);
  }
  if (!(out.ratio < kGone)) return out;
  while (0.5 * low_Hz > kLowest_Hz && most_between(0.5 * low_Hz, low_Hz) < kGone) low_Hz *= 0.5;
  out.from_Hz = low_Hz;
  return out;
}

}  // namespace asperity
