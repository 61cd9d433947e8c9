#include "asperity/rig/measure_grating.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

struct Wave {
  double s_m = 0.0;  // the window's middle
  double amplitude_m = 0.0;
  double phase_rad = 0.0;  // of A sin(ks + phase)
};

// Points [first, last) of the profile.
std::optional<Wave> fit_wave(const Profile& profile, std::size_t first, std::size_t last, double k) {
  const double middle_m = 0.5 * (profile.s_m[first] + profile.s_m[last - 1]);
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (std::size_t i = first; i < last; ++i) {
    if (!std::isfinite(profile.height_m[i])) return std::nullopt;
    const double s_m = profile.s_m[i];
    const Eigen::Vector4d row(1.0, k * (s_m - middle_m), std::cos(k * s_m), std::sin(k * s_m));
    normal.noalias() += row * row.transpose();
    right += row * profile.height_m[i];
  }
  const Eigen::Vector4d x = normal.ldlt().solve(right);
  return Wave{middle_m, std::hypot(x[2], x[3]), std::atan2(x[2], x[3])};
}

std::vector<Wave> fit_waves(const Profile& profile, double k) {
  std::vector<Wave> out;
  const double points = 2.0 * kTwoPi / k / profile.spacing_m;
  const auto window = static_cast<std::size_t>(std::max(8.0, std::round(points)));
  for (std::size_t first = 0; first + window <= profile.size();) {
    std::optional<Wave> wave = fit_wave(profile, first, first + window, k);
    if (!wave) {
      ++first;
      continue;
    }
    if (!out.empty()) {
      // The turn nearest to the one before.
      wave->phase_rad += kTwoPi * std::round((out.back().phase_rad - wave->phase_rad) / kTwoPi);
    }
    out.push_back(*wave);
    first += window;
  }
  return out;
}

void compare_shape(const Profile& profile, const TracedSine& sine, double k, const LinearFit& phase,
                   GratingMetrics& out) {
  std::vector<double> measured, reference;
  measured.reserve(profile.size());
  reference.reserve(profile.size());
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (!std::isfinite(profile.texture_m[i])) continue;
    const double s_m = profile.s_m[i];
    if (s_m < out.start_m || s_m > out.start_m + out.length_m) continue;
    measured.push_back(profile.texture_m[i]);
    reference.push_back(sine.height_m(k * s_m + phase.intercept + phase.slope * s_m));
  }
  if (measured.size() < 8) return;
  const double measured_mean = mean(measured);
  const double reference_mean = mean(reference);
  double square = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double error = (measured[i] - measured_mean) - (reference[i] - reference_mean);
    square += error * error;
  }
  out.shape_rms_m = std::sqrt(square / static_cast<double>(measured.size()));
  out.correlation = correlation(measured, reference);
}

}  // namespace

GratingMetrics measure_grating(const Profile& profile, double found_pitch_m, const SineGratingConfig& sine,
                               double tip_radius_m) {
  const TracedSine traced(sine, tip_radius_m);
  GratingMetrics out;
  if (!(found_pitch_m > 4.0 * profile.spacing_m)) return out;
  const double k = kTwoPi / found_pitch_m;
  const std::vector<Wave> waves = fit_waves(profile, k);
  out.windows = waves.size();
  constexpr std::size_t kFewest = 4;
  if (waves.size() < kFewest) return out;
  std::vector<double> s_m, phase_rad, amplitude_m;
  for (const Wave& wave : waves) {
    s_m.push_back(wave.s_m);
    phase_rad.push_back(wave.phase_rad);
    amplitude_m.push_back(wave.amplitude_m);
  }
  const LinearFit phase = linear_regression(s_m, phase_rad);
  const double turned = k + phase.slope;
  if (!(turned > 0.0)) return out;
  out.pitch_m = kTwoPi / turned;
  out.pitch_stderr_m = out.pitch_m * phase.slope_error / turned;
  out.along_rms_m = phase.residual / turned;
  out.start_m = s_m.front() - found_pitch_m;
  out.length_m = s_m.back() - s_m.front() + 2.0 * found_pitch_m;
  out.length_error_m = out.length_m * (1.0 - sine.pitch_m / out.pitch_m);
  const double depth_over_amplitude = 2.0 / traced.fundamental_share();
  out.depth_m = depth_over_amplitude * mean(amplitude_m);
  out.depth_stderr_m =
      depth_over_amplitude * standard_deviation(amplitude_m) / std::sqrt(static_cast<double>(waves.size()));
  compare_shape(profile, traced, k, phase, out);
  return out;
}

}  // namespace asperity
