#include "asperity/trajectory/inertial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const double kQuantisation_counts = 1.0 / std::sqrt(12.0);  // standard deviation of rounding to a count

// Noise of one sample, per channel, from the second difference in the quietest tenth of short windows:
// motion of a hand and texture is mostly slower or absent there.
Eigen::Vector3d quiet_noise(const std::vector<Eigen::Vector3d>& x) {
  constexpr std::size_t kWindow = 64;
  Eigen::Vector3d noise = Eigen::Vector3d::Zero();
  if (x.size() < 2 * kWindow) return noise;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> levels;
    for (std::size_t start = 1; start + kWindow + 1 < x.size(); start += kWindow) {
      double sum = 0.0;
      for (std::size_t i = start; i < start + kWindow; ++i) {
        const double second = x[i - 1][axis] - 2.0 * x[i][axis] + x[i + 1][axis];
        sum += second * second;
      }
      if (std::isfinite(sum)) levels.push_back(std::sqrt(sum / (6.0 * kWindow)));
    }
    if (levels.empty()) continue;
    const auto tenth = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 10);
    std::nth_element(levels.begin(), tenth, levels.end());
    noise[axis] = *tenth;
  }
  return noise;
}

// Marks samples that stand off from both neighbours while these agree, in any channel of `x`, and
// returns the size of the deviation (0 where none).
void find_spikes(const std::vector<Eigen::Vector3d>& x, double sigmas, std::vector<char>& spike) {
  if (x.size() < 5) return;
  for (int axis = 0; axis < 3; ++axis) {
    // The usual size of the deviation from the neighbours' mean, smoothly forgotten over 200 samples;
    // a resolved impact raises it and is kept.
    double usual = 0.0;
    std::size_t counted = 0;
    for (std::size_t i = 1; i + 1 < std::min<std::size_t>(x.size(), 201); ++i) {
      usual += std::abs(x[i][axis] - 0.5 * (x[i - 1][axis] + x[i + 1][axis]));
      ++counted;
    }
    usual = std::max(usual / static_cast<double>(counted), 0.5);
    for (std::size_t i = 1; i + 1 < x.size(); ++i) {
      const double deviation = std::abs(x[i][axis] - 0.5 * (x[i - 1][axis] + x[i + 1][axis]));
      const double neighbours = std::abs(x[i + 1][axis] - x[i - 1][axis]);
      const bool found = deviation > sigmas * 1.25 * usual && neighbours < 0.25 * deviation;
      if (found) spike[i] = 1;
      if (!found) usual = std::max(0.5, usual + (std::min(deviation, 10.0 * usual) - usual) / 200.0);
    }
  }
}

// nan cells filled by straight lines between the values present; constant beyond the first and last.
std::vector<double> fill_between(const std::vector<std::int64_t>& t_ns, const std::vector<double>& x) {
  std::vector<double> out = x;
  std::size_t previous = x.size();
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isnan(x[i])) continue;
    if (previous == x.size()) {
      std::fill(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(i), x[i]);
    } else {
      for (std::size_t j = previous + 1; j < i; ++j) {
        const double share =
            static_cast<double>(t_ns[j] - t_ns[previous]) / static_cast<double>(t_ns[i] - t_ns[previous]);
        out[j] = x[previous] + share * (x[i] - x[previous]);
      }
    }
    previous = i;
  }
  if (previous < x.size()) std::fill(out.begin() + static_cast<std::ptrdiff_t>(previous), out.end(), x[previous]);
  return out;
}

bool at_limit(const Eigen::Vector3d& counts, const RecordingInfo& info) {
  return info.adc_max > info.adc_min &&
         ((counts.array() <= info.adc_min).any() || (counts.array() >= info.adc_max).any());
}

// Adds, to each sample, the error that a share of the moving part of the signal may carry.
void add_scale_error(const std::vector<Eigen::Vector3d>& x, double share, std::size_t window,
                     std::vector<double>& sigma) {
  if (share <= 0.0 || x.empty()) return;
  const double forget = 1.0 / static_cast<double>(std::max<std::size_t>(window, 2));
  Eigen::Vector3d mean = x.front();
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean += forget * (x[i] - mean);
    const double moving = share * (x[i] - mean).norm();
    sigma[i] = std::sqrt(sigma[i] * sigma[i] + moving * moving);
  }
}

}  // namespace

InertialStream calibrate_inertial(const Recording& recording, const InertialConfig& config) {
  const ProbeStream& probe = recording.probe;
  const Calibration& calibration = recording.calibration;
  const RecordingInfo& info = recording.info;
  const std::size_t n = probe.size();
  if (n < 2) throw Error("probe.csv: " + std::to_string(n) + " samples are too few");

  InertialStream out;
  SmoothClockResult clock = smooth_clock(probe.t_ns, config.clock);
  out.t_ns = std::move(clock.t_ns);
  out.period_s = clock.period_s;
  out.clock_jitter_s = clock.applied ? clock.jitter_s : 0.0;
  out.has_gyro = probe.has_gyro() && calibration.gyroscope.has_value();

  std::vector<char> spike(n, 0);
  find_spikes(probe.accel_counts, config.spike_sigmas, spike);
  if (out.has_gyro) find_spikes(probe.gyro_counts, config.spike_sigmas, spike);
  spike.front() = spike.back() = 0;

  const Eigen::Matrix3d B = calibration.accelerometer.B.leftCols<3>();
  const double accel_scale = std::pow(std::abs(B.determinant()), 1.0 / 3.0);  // counts per m/s²
  if (!(accel_scale > 0.0) || !std::isfinite(accel_scale)) throw Error("calibration.json: accelerometer.B is singular");
  out.accel_noise_mps2 = config.accel_noise_floor_mps2 > 0.0
                             ? config.accel_noise_floor_mps2
                             : std::max(kQuantisation_counts, quiet_noise(probe.accel_counts).mean()) / accel_scale;
  const double saturated_sigma = config.saturation_sigma * 0.5 * (info.adc_max - info.adc_min) / accel_scale;

  out.specific_force_mps2.resize(n);
  out.accel_sigma_mps2.assign(n, out.accel_noise_mps2);
  const bool linear = calibration.accelerometer.model != AccelerometerModel::kQuadric;
  const Eigen::Matrix3d inverse = B.inverse();
  Eigen::Matrix3d gyro_inverse = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gyro_offset = Eigen::Vector3d::Zero();
  if (out.has_gyro) {
    const Eigen::Matrix3d& G = calibration.gyroscope->B;
    const double gyro_scale = std::pow(std::abs(G.determinant()), 1.0 / 3.0);
    if (!(gyro_scale > 0.0) || !std::isfinite(gyro_scale)) throw Error("calibration.json: gyroscope.B is singular");
    gyro_inverse = G.inverse();
    gyro_offset = calibration.gyroscope->C;
    out.gyro_noise_radps = config.gyro_noise_floor_radps > 0.0
                               ? config.gyro_noise_floor_radps
                               : std::max(kQuantisation_counts, quiet_noise(probe.gyro_counts).mean()) / gyro_scale;
  }
  out.angular_rate_radps.assign(n, Eigen::Vector3d::Zero());
  out.gyro_sigma_radps.assign(n, out.gyro_noise_radps);
  Eigen::Vector3d gyro_held = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Vector3d counts = probe.accel_counts[i];
    if (spike[i]) counts = 0.5 * (probe.accel_counts[i - 1] + probe.accel_counts[i + 1]);
    out.specific_force_mps2[i] = linear ? Eigen::Vector3d(inverse * (counts - calibration.accelerometer.C))
                                        : calibration.accelerometer.specific_force_mps2(counts);
    if (out.has_gyro) {
      Eigen::Vector3d gyro = probe.gyro_counts[i];
      if (spike[i]) gyro = 0.5 * (probe.gyro_counts[i - 1] + probe.gyro_counts[i + 1]);
      if (gyro.allFinite()) gyro_held = gyro_inverse * (gyro - gyro_offset);
      out.angular_rate_radps[i] = gyro_held;
      if (at_limit(probe.gyro_counts[i], info)) out.gyro_sigma_radps[i] = gyro_held.norm();
    }
  }
  add_scale_error(out.specific_force_mps2, config.scale_error,
                  static_cast<std::size_t>(0.2 / std::max(out.period_s, 1e-6)), out.accel_sigma_mps2);
  for (std::size_t i = 0; i < n; ++i) {
    if (spike[i]) {
      ++out.spikes;
      const Eigen::Vector3d step = out.specific_force_mps2[i + 1] - out.specific_force_mps2[i - 1];
      out.accel_sigma_mps2[i] = std::hypot(3.0 * out.accel_sigma_mps2[i], 0.5 * step.norm());
    } else if (at_limit(probe.accel_counts[i], info)) {
      ++out.saturated;
      out.accel_sigma_mps2[i] = std::max(out.accel_sigma_mps2[i], saturated_sigma);
    }
  }
  std::vector<double> force(n);
  for (std::size_t i = 0; i < n; ++i) {
    force[i] = spike[i] ? kNan : calibration.force.force_N(probe.force_counts[i]);
  }
  out.force_N = fill_between(out.t_ns, force);
  if (out.spikes > 0)
    out.problems.push_back({"spike", "samples that stand off from both their neighbours were replaced", out.spikes});
  if (out.saturated > 0)
    out.problems.push_back(
        {"saturation", "accelerometer samples at the end of their range lost their weight", out.saturated});
  return out;
}

}  // namespace asperity
