#include "asperity/trajectory/calibrate_inertial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "clipped_peaks.h"

namespace asperity {

namespace {

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

// Counts, for every sample, the channels of `x` in which it stands off from its four neighbours while
// these agree. A peak of the sensor's own, band-limited, raises its neighbours too.
void count_spiking_channels(const std::vector<Eigen::Vector3d>& x, double sigmas, std::vector<int>& channels) {
  if (x.size() < 5) return;
  constexpr double kForget = 1.0 / 200.0;  // a sample
  for (int axis = 0; axis < 3; ++axis) {
    const auto deviation_at = [&](std::size_t i) {
      return std::abs(x[i][axis] - 0.5 * (x[i - 1][axis] + x[i + 1][axis]));
    };
    // The usual size of the deviation: a rough stretch raises it.
    double usual = 0.0;
    const std::size_t start = std::min<std::size_t>(x.size() - 1, 201);
    for (std::size_t i = 1; i < start; ++i) usual += deviation_at(i) / static_cast<double>(start - 1);
    for (std::size_t i = 2; i + 2 < x.size(); ++i) {
      usual = std::max(usual, 0.5);  // count
      const double deviation = deviation_at(i);
      const auto [low, high] = std::minmax({x[i - 2][axis], x[i - 1][axis], x[i + 1][axis], x[i + 2][axis]});
      const bool found = deviation > sigmas * 1.25 * usual && high - low < 0.35 * deviation;
      // One channel alone must stand out far more: a converter's glitch, where two are a corrupted frame.
      const bool glitch = deviation > 4.0 * sigmas * 1.25 * usual && high - low < 0.1 * deviation;
      if (found) channels[i] += glitch ? 2 : 1;
      if (!found) usual += kForget * (std::min(deviation, 10.0 * usual) - usual);
    }
  }
}

// Samples that are a corrupted frame and not a motion: it strikes several channels at once (seed §4.1).
std::vector<char> find_spikes(const ProbeStream& probe, const std::vector<Eigen::Vector3d>& gyro_counts,
                              double sigmas) {
  std::vector<int> channels(probe.size(), 0);
  count_spiking_channels(probe.accel_counts, sigmas, channels);
  count_spiking_channels(gyro_counts, sigmas, channels);
  std::vector<char> spike(probe.size(), 0);
  for (std::size_t i = 0; i < probe.size(); ++i) spike[i] = channels[i] >= 2;
  return spike;
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

// The force on the tip in the marker frame at every sample; empty without a calibrated sensor of three axes.
std::vector<Eigen::Vector3d> force_vectors(const Recording& recording, const std::vector<char>& spike,
                                           const std::vector<std::int64_t>& t_ns) {
  const std::vector<Eigen::Vector3d>& counts = recording.probe.force3_counts;
  if (!recording.calibration.force3 || counts.size() != t_ns.size()) return {};
  const Force3Calibration& calibration = *recording.calibration.force3;
  calibration.force_N(calibration.C);  // throws if there is no inverse
  const Eigen::Matrix3d inverse = calibration.B.inverse();
  std::vector<Eigen::Vector3d> out(counts.size());
  std::vector<double> component(counts.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < counts.size(); ++i)
      component[i] = spike[i] ? kNan : inverse.row(axis).dot(counts[i] - calibration.C);
    component = fill_between(t_ns, component);
    for (std::size_t i = 0; i < counts.size(); ++i) out[i][axis] = component[i];
  }
  return out;
}

// A gyroscope slower than a hand's turns says less than the tracker.
constexpr double kSlowestGyro_Hz = 25.0;

double readings_per_second(const std::vector<std::int64_t>& t_ns, const std::vector<Eigen::Vector3d>& counts) {
  const auto readings = std::count_if(counts.begin(), counts.end(), [](const auto& c) { return c.allFinite(); });
  return static_cast<double>(readings) / (static_cast<double>(t_ns.back() - t_ns.front()) * 1e-9);
}

// The gyroscope's counts with rows that have none, because it is slower, filled by straight lines.
std::vector<Eigen::Vector3d> filled_gyro(const std::vector<std::int64_t>& t_ns,
                                         const std::vector<Eigen::Vector3d>& counts) {
  std::vector<Eigen::Vector3d> out = counts;
  std::vector<double> axis_counts(counts.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < counts.size(); ++i) axis_counts[i] = counts[i][axis];
    axis_counts = fill_between(t_ns, axis_counts);
    for (std::size_t i = 0; i < counts.size(); ++i) out[i][axis] = axis_counts[i];
  }
  return out;
}

// The noise of one reading as that of one row of the same density, where only some rows have a reading.
double row_noise_counts(const std::vector<Eigen::Vector3d>& counts) {
  std::vector<Eigen::Vector3d> readings;
  readings.reserve(counts.size());
  std::copy_if(counts.begin(), counts.end(), std::back_inserter(readings), [](const auto& c) { return c.allFinite(); });
  const double rows_per_reading = static_cast<double>(counts.size()) / static_cast<double>(readings.size());
  return std::sqrt(rows_per_reading) * std::max(kQuantisation_counts, quiet_noise(readings).mean());
}

bool at_limit(const Eigen::Vector3d& counts, const RecordingInfo& info) {
  return info.adc_max > info.adc_min &&
         ((counts.array() <= info.adc_min).any() || (counts.array() >= info.adc_max).any());
}

// The size of each sample less the mean of the samples before it.
std::vector<double> moving_part(const std::vector<Eigen::Vector3d>& x, std::size_t window) {
  const double forget = 1.0 / static_cast<double>(std::max<std::size_t>(window, 2));
  Eigen::Vector3d mean = x.front();
  std::vector<double> out;
  out.reserve(x.size());
  for (const Eigen::Vector3d& now : x) {
    mean += forget * (now - mean);
    out.push_back((now - mean).norm());
  }
  return out;
}

// What is as fast as the sampling itself: the sixth difference, of the size of white noise that leaves as much. At a
// tenth of the rate its gain is 1e-3 of that at half of it. Means of its products over `reach` samples to either side.
std::vector<Eigen::Matrix<float, 6, 1>> fast_part(const std::vector<Eigen::Vector3d>& x, std::size_t reach) {
  using Products = Eigen::Matrix<double, 6, 1>;
  const std::size_t n = x.size();
  const auto products = [&](std::size_t i) -> Products {
    if (i < 3 || i + 3 >= n) return Products::Zero();
    const Eigen::Vector3d u =
        20.0 * x[i] - 15.0 * (x[i - 1] + x[i + 1]) + 6.0 * (x[i - 2] + x[i + 2]) - (x[i - 3] + x[i + 3]);
    return (1.0 / 924.0) *
           (Products() << u[0] * u[0], u[1] * u[1], u[2] * u[2], u[0] * u[1], u[0] * u[2], u[1] * u[2]).finished();
  };
  std::vector<Eigen::Matrix<float, 6, 1>> out(n);
  Products sum = Products::Zero();
  for (std::size_t i = 0; i < std::min(reach, n); ++i) sum += products(i);
  for (std::size_t i = 0; i < n; ++i) {
    if (i + reach < n) sum += products(i + reach);
    if (i > reach) sum -= products(i - reach - 1);
    const std::size_t first = i - std::min(i, reach), last = std::min(i + reach, n - 1);
    out[i] = (sum / static_cast<double>(last - first + 1)).cast<float>();
  }
  return out;
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
  std::vector<Eigen::Vector3d> gyro_counts;
  if (calibration.gyroscope && readings_per_second(out.t_ns, probe.gyro_counts) >= kSlowestGyro_Hz) {
    gyro_counts = filled_gyro(out.t_ns, probe.gyro_counts);
  } else if (calibration.gyroscope && probe.has_gyro()) {
    out.problems.push_back({"slow_gyroscope", "the gyroscope gave too few readings and was left out", 1});
  }
  out.has_gyro = !gyro_counts.empty();

  const std::vector<char> spike = find_spikes(probe, gyro_counts, config.spike_sigmas);

  const Eigen::Matrix3d B = calibration.accelerometer.B.leftCols<3>();
  const double accel_scale = std::pow(std::abs(B.determinant()), 1.0 / 3.0);  // counts per m/s²
  if (!(accel_scale > 0.0) || !std::isfinite(accel_scale)) throw Error("calibration.json: accelerometer.B is singular");
  out.accel_noise_mps2 = config.accel_noise_floor_mps2 > 0.0
                             ? config.accel_noise_floor_mps2
                             : std::max(kQuantisation_counts, quiet_noise(probe.accel_counts).mean()) / accel_scale;

  const Eigen::Matrix3d inverse = B.inverse();
  std::vector<Eigen::Vector3d> accel_counts = probe.accel_counts;
  std::vector<double> clipped_sigma_mps2(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (spike[i]) accel_counts[i] = 0.5 * (probe.accel_counts[i - 1] + probe.accel_counts[i + 1]);
  }
  const std::vector<ClippedRun> clipped = find_clipped(accel_counts, info);
  std::array<std::array<double, 2>, 3> restoration{};  // by axis and side
  for (const ClippedRun& run : clipped) {
    double& error = restoration[static_cast<std::size_t>(run.axis)][run.upper ? 1 : 0];
    if (error == 0.0) error = restoration_error(probe.accel_counts, info, run.axis, run.upper);
  }
  for (const ClippedRun& run : clipped) {
    const double added = restore_peak(run, accel_counts);
    // A long run hides its peak altogether.
    const double hidden =
        std::min(1.0, static_cast<double>(run.last - run.first) / 10.0) * 0.5 * (info.adc_max - info.adc_min);
    const double sigma_counts = config.saturation_sigma * std::max(added, hidden);
    // A long run has no trial.
    const double error = restoration[static_cast<std::size_t>(run.axis)][run.upper ? 1 : 0];
    const bool tried = std::isfinite(error) && run.last - run.first <= kLongestTried;
    const double run_s = static_cast<double>(run.last - run.first) * out.period_s;
    const Eigen::Vector3d velocity_mps = (tried ? error * added : sigma_counts) * run_s * inverse.col(run.axis);
    out.clipped_m2ps3 += 2.0 * velocity_mps.cwiseAbs2() / (static_cast<double>(n) * out.period_s);
    for (std::size_t i = run.first; i < run.last; ++i)
      clipped_sigma_mps2[i] = std::max(clipped_sigma_mps2[i], sigma_counts / accel_scale);
  }

  out.specific_force_mps2.resize(n);
  out.accel_sigma_mps2.assign(n, out.accel_noise_mps2);
  const bool linear = calibration.accelerometer.model != AccelerometerModel::kQuadric;
  Eigen::Matrix3d gyro_inverse = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gyro_offset = Eigen::Vector3d::Zero();
  if (out.has_gyro) {
    const Eigen::Matrix3d& G = calibration.gyroscope->B;
    const double gyro_scale = std::pow(std::abs(G.determinant()), 1.0 / 3.0);
    if (!(gyro_scale > 0.0) || !std::isfinite(gyro_scale)) throw Error("calibration.json: gyroscope.B is singular");
    gyro_inverse = G.inverse();
    gyro_offset = calibration.gyroscope->C;
    out.gyro_noise_radps = config.gyro_noise_floor_radps > 0.0 ? config.gyro_noise_floor_radps
                                                               : row_noise_counts(probe.gyro_counts) / gyro_scale;
  }
  out.angular_rate_radps.assign(n, Eigen::Vector3d::Zero());
  out.gyro_sigma_radps.assign(n, out.gyro_noise_radps);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d& counts = accel_counts[i];
    out.specific_force_mps2[i] = linear ? Eigen::Vector3d(inverse * (counts - calibration.accelerometer.C))
                                        : calibration.accelerometer.specific_force_mps2(counts);
    if (out.has_gyro) {
      const Eigen::Vector3d gyro =
          spike[i] ? Eigen::Vector3d(0.5 * (gyro_counts[i - 1] + gyro_counts[i + 1])) : gyro_counts[i];
      out.angular_rate_radps[i] = gyro_inverse * (gyro - gyro_offset);
      if (at_limit(probe.gyro_counts[i], info)) out.gyro_sigma_radps[i] = out.angular_rate_radps[i].norm();
    }
  }
  out.accel_moving_mps2 =
      moving_part(out.specific_force_mps2, static_cast<std::size_t>(0.2 / std::max(out.period_s, 1e-6)));
  out.accel_fast_m2ps4 =
      fast_part(out.specific_force_mps2, static_cast<std::size_t>(config.fast_reach_s / std::max(out.period_s, 1e-6)));
  for (std::size_t i = 0; i < n; ++i) {
    if (spike[i]) {
      ++out.spikes;
      const Eigen::Vector3d step = out.specific_force_mps2[i + 1] - out.specific_force_mps2[i - 1];
      out.accel_sigma_mps2[i] = std::hypot(3.0 * out.accel_sigma_mps2[i], 0.5 * step.norm());
    }
    if (clipped_sigma_mps2[i] > 0.0) {
      ++out.saturated;
      out.accel_sigma_mps2[i] = std::hypot(out.accel_sigma_mps2[i], clipped_sigma_mps2[i]);
    }
  }
  std::vector<double> force(n);
  for (std::size_t i = 0; i < n; ++i) {
    force[i] = spike[i] ? kNan : calibration.force.force_N(probe.force_counts[i]);
  }
  out.force_N = fill_between(out.t_ns, force);
  out.force3_marker_N = force_vectors(recording, spike, out.t_ns);
  if (out.spikes > 0)
    out.problems.push_back({"spike", "samples that are far from both their neighbours were replaced", out.spikes});
  if (out.saturated > 0)
    out.problems.push_back(
        {"saturation", "accelerometer samples at the end of their range were down-weighted", out.saturated});
  return out;
}

}  // namespace asperity
