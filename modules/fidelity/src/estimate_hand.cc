#include "asperity/fidelity/estimate_hand.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "asperity/fidelity/signal_agreement.h"
#include "asperity/profile/normal_force.h"
#include "asperity/signal/zero_phase.h"

namespace asperity {

namespace {

constexpr double kLeastExplained = 0.5, kSteepest = 1.0;

// Least squares with all values at least 0: the best of the 2³ choices of those that are not 0 whose solution has none
// below.
Eigen::Vector3d least_squares_above_zero(const Eigen::Matrix3d& normal, const Eigen::Vector3d& right) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double most = 0.0;
  for (unsigned mask = 1; mask < 8; ++mask) {
    Eigen::Matrix3d matrix = normal;
    Eigen::Vector3d side = right;
    for (int j = 0; j < 3; ++j) {
      if ((mask >> j & 1U) != 0) continue;
      matrix.row(j).setZero();
      matrix.col(j).setZero();
      matrix(j, j) = 1.0;
      side(j) = 0.0;
    }
    const Eigen::Vector3d x = matrix.ldlt().solve(side);
    if (!x.allFinite() || x.minCoeff() < 0.0) continue;
    const double gain = 2.0 * x.dot(right) - x.dot(normal * x);
    if (gain <= most) continue;
    most = gain;
    best = x;
  }
  return best;
}

}  // namespace

HandImpedance estimate_hand(const StrokeSignals& stroke, const PathGrid& grid, double segment_m,
                            double low_cycles_per_mm, double high_cycles_per_mm, const VirtualProbeConfig& config) {
  HandImpedance assumed;
  assumed.damping_N_s_per_m = config.hand_damping_N_s_per_m;
  assumed.stiffness_N_per_m = config.hand_stiffness_N_per_m;
  if (config.mass_kg > 0.0) {
    assumed.mass_kg = config.mass_kg;
    return assumed;
  }
  const std::size_t n = stroke.size();
  const std::vector<double> slow_N =
      through_pole(stroke.t_s, stroke.normal_N, std::max(0.5, 1e3 * low_cycles_per_mm * stroke.usual_mps));
  std::array<std::vector<double>, 3> regressors;
  std::vector<double> slope_N(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double share = stroke.reads_normal[i] - FrictionAssumption{}.coefficient * stroke.reads_tangential[i];
    const double speed = std::max(stroke.speed_mps[i], 0.3 * stroke.usual_mps);
    slope_N[i] =
        slow_N[i] * std::clamp(stroke.climb_mps[i] / speed, -kSteepest, kSteepest) * stroke.reads_tangential[i];
    regressors[0].push_back(share * stroke.accel_mps2[i]);
    regressors[1].push_back(share * stroke.climb_mps[i]);
    regressors[2].push_back(share * stroke.height_m[i]);
  }
  slope_N = through_pole(stroke.t_s, slope_N, config.force_bandwidth_Hz);
  std::vector<double> left_N(n);
  for (std::size_t i = 0; i < n; ++i) left_N[i] = stroke.force_N[i] + slope_N[i];  // nan between readings
  const std::vector<double> y = over_path(stroke, left_N, grid);
  std::array<std::vector<double>, 3> x;
  for (std::size_t j = 0; j < 3; ++j)
    x[j] = over_path(stroke, through_pole(stroke.t_s, regressors[j], config.force_bandwidth_Hz), grid);

  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double power = 0.0;
  const auto inner = [&](const std::vector<double>& a, const std::vector<double>& b) {
    const CrossSpectra spectra = cross_spectra(a, b, grid.spacing_m, segment_m);
    BandSignals band;
    band.low_cycles_per_mm = low_cycles_per_mm;
    band.high_cycles_per_mm = high_cycles_per_mm;
    band.is_compared = true;
    const SignalAgreement sum = agreement_of(spectra, {band}, spectra.segments(), 0.01);
    return sum.correlation * sum.real_rms * sum.other_rms;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    right(row) = inner(x[i], y);
    for (std::size_t j = i; j < 3; ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      normal(row, column) = normal(column, row) = inner(x[i], x[j]);
    }
  }
  power = inner(y, y);
  if (!normal.allFinite() || !right.allFinite() || !(power > 0.0)) return assumed;
  // In units in which the three are alike.
  const Eigen::Vector3d scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::Vector3d solution =
      scale.asDiagonal() *
      least_squares_above_zero(scale.asDiagonal() * normal * scale.asDiagonal(), scale.asDiagonal() * right);
  HandImpedance out;
  out.mass_kg = solution(0);
  out.damping_N_s_per_m = solution(1);
  out.stiffness_N_per_m = solution(2);
  out.explained = (2.0 * solution.dot(right) - solution.dot(normal * solution)) / power;
  out.measured = out.mass_kg > 1e-3 && out.explained >= kLeastExplained;
  if (out.measured) return out;
  assumed.explained = out.explained;
  return assumed;
}

}  // namespace asperity
