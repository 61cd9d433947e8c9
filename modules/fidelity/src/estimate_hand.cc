#include "asperity/fidelity/estimate_hand.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "asperity/base/nan.h"
#include "asperity/fidelity/signal_agreement.h"
#include "asperity/profile/normal_force.h"
#include "asperity/signal/zero_phase.h"

namespace asperity {

namespace {

constexpr double kSignificant = 3.0, kSteepest = 1.0;
constexpr double kLeastResidual = 1e-3;  // of a band's power: no model is better
constexpr int kPasses = 4;

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

// Mean products of regressors and reading in one band.
struct BandProducts {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double power = 0.0;
  double freedom = 1.0;  // independent values in it

  double left_over(const Eigen::Vector3d& x) const { return power - 2.0 * x.dot(right) + x.dot(normal * x); }
};

std::vector<BandProducts> band_products(const std::array<std::vector<double>, 3>& x, const std::vector<double>& y,
                                        const PathGrid& grid, double segment_m, double low_cycles_per_mm,
                                        double high_cycles_per_mm) {
  std::vector<BandProducts> out;
  const auto inner = [&](const std::vector<double>& a, const std::vector<double>& b) {
    const CrossSpectra spectra = cross_spectra(a, b, grid.spacing_m, segment_m);
    return agreement_of(spectra, third_octaves(spectra, low_cycles_per_mm, high_cycles_per_mm), spectra.segments(),
                        0.01)
        .bands;
  };
  const auto fill = [&](const std::vector<BandSignals>& bands, const auto& set) {
    out.resize(bands.size());
    for (std::size_t b = 0; b < bands.size(); ++b)
      set(out[b], bands[b].correlation * bands[b].real_rms * bands[b].other_rms);
  };
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::vector<double>& xi = x[static_cast<std::size_t>(i)];
    fill(inner(xi, y), [i](BandProducts& band, double value) { band.right(i) = value; });
    for (Eigen::Index j = i; j < 3; ++j) {
      fill(inner(xi, x[static_cast<std::size_t>(j)]),
           [i, j](BandProducts& band, double value) { band.normal(i, j) = band.normal(j, i) = value; });
    }
  }
  const std::vector<BandSignals> bands = inner(y, y);
  fill(bands, [](BandProducts& band, double value) { band.power = value; });
  const auto known = std::count_if(y.begin(), y.end(), [](double value) { return std::isfinite(value); });
  const double length_mm = 1e3 * grid.spacing_m * static_cast<double>(known);
  for (std::size_t b = 0; b < out.size(); ++b)
    out[b].freedom = std::max(1.0, 2.0 * (bands[b].high_cycles_per_mm - bands[b].low_cycles_per_mm) * length_mm);
  return out;
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
    const double speed = std::max(stroke.travel_mps[i], 0.3 * stroke.usual_mps);
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
  for (std::vector<double>& one : x)
    for (std::size_t i = 0; i < one.size(); ++i)
      if (!std::isfinite(y[i])) one[i] = kNan;

  const std::vector<BandProducts> bands = band_products(x, y, grid, segment_m, low_cycles_per_mm, high_cycles_per_mm);
  Eigen::Vector3d solution = Eigen::Vector3d::Zero();
  std::vector<double> weight(bands.size(), 1.0);
  double mass_sigma_kg = 0.0;
  for (int pass = 0; pass < kPasses; ++pass) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t b = 0; b < bands.size(); ++b) {
      normal += weight[b] * bands[b].normal;
      right += weight[b] * bands[b].right;
    }
    if (!normal.allFinite() || !right.allFinite()) return assumed;
    // In units in which the three are alike.
    const Eigen::Vector3d scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    solution = scale.asDiagonal() *
               least_squares_above_zero(scale.asDiagonal() * normal * scale.asDiagonal(), scale.asDiagonal() * right);
    mass_sigma_kg = std::sqrt(normal.inverse()(0, 0));  // of the last pass: weights are then inverse variances
    for (std::size_t b = 0; b < bands.size(); ++b)
      weight[b] = bands[b].freedom / std::max(bands[b].left_over(solution), kLeastResidual * bands[b].power);
  }
  double power = 0.0, left_over = 0.0;
  for (const BandProducts& band : bands) {
    power += band.power;
    left_over += band.left_over(solution);
  }
  if (!(power > 0.0)) return assumed;
  HandImpedance out;
  out.mass_kg = solution(0);
  out.damping_N_s_per_m = solution(1);
  out.stiffness_N_per_m = solution(2);
  out.explained = 1.0 - left_over / power;
  out.mass_sigma_kg = mass_sigma_kg;
  out.measured = out.mass_kg >= kSignificant * mass_sigma_kg && out.mass_kg > 0.0;
  if (out.measured) return out;
  assumed.explained = out.explained;
  assumed.mass_sigma_kg = mass_sigma_kg;
  return assumed;
}

}  // namespace asperity
