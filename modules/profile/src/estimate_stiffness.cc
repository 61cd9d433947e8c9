#include "asperity/profile/estimate_stiffness.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/spectrum.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kRate_hz = 50.0;
constexpr std::size_t kFirstBin = 2;      // the taper spreads what the straight line leaves over the bins below
constexpr std::ptrdiff_t kSmoothing = 3;  // bins to either side in the residual's spectrum
// Neighbouring bins of a Hann-tapered series correlate by 2/3 and 1/6: the variance of a sum over many
// grows by 1 + 2·(2/3)² + 2·(1/6)².
constexpr double kTaperVariance = 1.0 + 2.0 * 4.0 / 9.0 + 2.0 / 36.0;

constexpr double kBoundSigmas = 1.959963984540054;
constexpr int kMostWaves = 12;  // polynomials
constexpr double kSeen = 1e-9;  // of the largest eigenvalue: a movement of the base below it is not seen

struct Bins {
  std::vector<std::complex<double>> height, force;
};

std::vector<double> without_line(std::vector<double> x) {
  std::vector<double> index(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) index[i] = static_cast<double>(i);
  const LinearFit line = linear_regression(index, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = 2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(x.size());
    x[i] = (x[i] - line.slope * index[i] - line.intercept) * 0.5 * (1.0 - std::cos(a));
  }
  return x;
}

struct Slope {
  double compliance = 0.0;  // m/N
  double variance = std::numeric_limits<double>::infinity();
  double degrees_of_freedom = std::numeric_limits<double>::infinity();
};

// Weighted least squares of -height on force, the weights from the residual's spectrum, iterated.
Slope regress_bins(const std::vector<Bins>& runs) {
  Slope out;
  std::size_t bins = 0;
  double cross = 0.0, power = 0.0;
  for (const Bins& run : runs) {
    bins += run.force.size();
    for (std::size_t k = 0; k < run.force.size(); ++k) {
      cross -= std::real(std::conj(run.force[k]) * run.height[k]);
      power += std::norm(run.force[k]);
    }
  }
  if (bins < 4 || !(power > 0.0)) return out;
  out.compliance = cross / power;
  for (int iteration = 0; iteration < 20; ++iteration) {
    cross = 0.0;
    power = 0.0;
    for (const Bins& run : runs) {
      const auto n = static_cast<std::ptrdiff_t>(run.force.size());
      std::vector<double> residual(run.force.size());
      for (std::size_t k = 0; k < run.force.size(); ++k)
        residual[k] = std::norm(run.height[k] + out.compliance * run.force[k]);
      for (std::ptrdiff_t k = 0; k < n; ++k) {
        double sum = 0.0, count = 0.0;
        for (auto j = std::max<std::ptrdiff_t>(0, k - kSmoothing); j <= std::min(n - 1, k + kSmoothing); ++j) {
          sum += residual[static_cast<std::size_t>(j)];
          count += 1.0;
        }
        if (!(sum > 0.0)) continue;
        const double weight = count / sum;
        const auto i = static_cast<std::size_t>(k);
        cross -= weight * std::real(std::conj(run.force[i]) * run.height[i]);
        power += weight * std::norm(run.force[i]);
      }
    }
    if (!(power > 0.0)) return out;
    out.compliance = cross / power;
  }
  // Each independent frequency has two parts, of which the weights, local means of the same residuals, take one.
  out.degrees_of_freedom = static_cast<double>(bins) / kTaperVariance;
  // Half the noise power of a bin lies along the force's phase; one parameter was fitted to `bins` of them.
  const double lost = 1.0 + 1.0 / (static_cast<double>(bins) / kTaperVariance);
  out.variance = 0.5 * kTaperVariance * lost / power;
  return out;
}

// What a base that is fitted to the path takes from a quantity of it: a rigid movement (n·δ and n·(ω × r)), another
// radius (1), and waves up to `cycles_per_m` of the arc length, as polynomials. One row a sample in contact, of the
// weight that the base's fit gives it, the way travelled.
Eigen::MatrixXd base_functions(const BasePath& base, const std::vector<std::size_t>& samples, double cycles_per_m) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::size_t i : samples) middle += base.p_world_m[i] / static_cast<double>(samples.size());
  double reach_m = 0.0;
  for (const std::size_t i : samples) reach_m = std::max(reach_m, (base.p_world_m[i] - middle).norm());
  const double first_m = base.s_m[samples.front()], length_m = base.s_m[samples.back()] - first_m;
  const int waves = std::min(kMostWaves, static_cast<int>(std::lround(2.0 * cycles_per_m * length_m)));
  Eigen::MatrixXd out(static_cast<Eigen::Index>(samples.size()), 7 + waves);
  for (std::size_t row = 0; row < samples.size(); ++row) {
    const auto r = static_cast<Eigen::Index>(row);
    const std::size_t i = samples[row];
    const Eigen::Vector3d& n = base.n_world[i];
    out.block<1, 3>(r, 0) = n.transpose();
    out.block<1, 3>(r, 3) = (base.p_world_m[i] - middle).cross(n).transpose() / std::max(reach_m, 1e-9);
    out(r, 6) = 1.0;
    // Legendre's, from the second on: the first are in the movement.
    const double x = length_m > 0.0 ? 2.0 * (base.s_m[i] - first_m) / length_m - 1.0 : 0.0;
    double before = 1.0, now = x;
    for (int d = 0; d < waves; ++d) {
      const double next = ((2.0 * d + 3.0) * x * now - (d + 1.0) * before) / (d + 2.0);
      out(r, 7 + d) = next;
      before = now, now = next;
    }
  }
  return out;
}

// Takes from both what the base's fit takes, so that height and force have lost the same: of a force that rises along
// the path a fitted base leaves next to nothing in the heights.
void take_base(const BasePath& base, std::span<const char> contact, double cycles_per_m, std::vector<double>& height_m,
               std::vector<double>& force_N) {
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < contact.size(); ++i) {
    if (contact[i] != 0) samples.push_back(i);
  }
  if (samples.size() < 2) return;
  const Eigen::MatrixXd functions = base_functions(base, samples, cycles_per_m);
  Eigen::VectorXd weight(functions.rows());
  for (Eigen::Index r = 0; r < functions.rows(); ++r) {
    const std::size_t i = samples[static_cast<std::size_t>(r)];
    if (!std::isfinite(height_m[i]) || !std::isfinite(force_N[i])) return;
    weight[r] = i > 0 ? std::max(0.0, base.s_m[i] - base.s_m[i - 1]) : 0.0;
  }
  if (!(weight.sum() > 0.0)) return;
  const Eigen::MatrixXd normal = functions.transpose() * weight.asDiagonal() * functions;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(normal);
  // What the path does not show is in no fit: a straight stroke does not turn about itself.
  const double least = kSeen * solver.eigenvalues().maxCoeff();
  const Eigen::VectorXd inverse = solver.eigenvalues().unaryExpr([&](double e) { return e > least ? 1.0 / e : 0.0; });
  Eigen::MatrixXd values(functions.rows(), 2);
  for (Eigen::Index r = 0; r < functions.rows(); ++r) {
    const std::size_t i = samples[static_cast<std::size_t>(r)];
    values(r, 0) = height_m[i];
    values(r, 1) = force_N[i];
  }
  const Eigen::MatrixXd fit = solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose() *
                              (functions.transpose() * (weight.asDiagonal() * values));
  const Eigen::MatrixXd taken = functions * fit;
  for (std::size_t r = 0; r < samples.size(); ++r) {
    height_m[samples[r]] -= taken(static_cast<Eigen::Index>(r), 0);
    force_N[samples[r]] -= taken(static_cast<Eigen::Index>(r), 1);
  }
}

}  // namespace

StiffnessEstimate estimate_stiffness(const TipMotion& motion, const BasePath& base, std::span<const char> contact,
                                     const StiffnessConfig& config, double base_cycles_per_mm) {
  const std::size_t n = motion.size();
  if (base.size() != n || base.s_m.size() != n || base.n_world.size() != n || contact.size() != n ||
      (!motion.force_N.empty() && motion.force_N.size() != n)) {
    throw Error("stiffness: motion, base path and marks differ in size (" + std::to_string(n) + " samples)");
  }
  StiffnessEstimate out;
  std::vector<double> t_s(n), height_m(n);
  for (std::size_t i = 0; i < n; ++i) {
    t_s[i] = static_cast<double>(motion.t_ns[i] - motion.t_ns[0]) * kNanosecond_s;
    height_m[i] = base.n_world[i].dot(motion.p_world_tip_m[i] - base.p_world_m[i]);
  }
  const bool measured =
      std::any_of(motion.force_N.begin(), motion.force_N.end(), [](double f) { return std::isfinite(f); });
  if (!measured || n < 2) {
    out.verdict = "no force was measured";
    return out;
  }
  std::vector<double> force_N = bridge_gaps(t_s, motion.force_N);
  take_base(base, contact, 1e3 * base_cycles_per_mm, height_m, force_N);

  std::vector<Bins> runs;
  double square = 0.0, travelled_m = 0.0;
  std::size_t cells_used = 0;
  struct Run {
    std::vector<double> height_m, force_N;
  };
  std::vector<Run> series;
  for (std::size_t begin = 0; begin < n;) {
    std::size_t end = begin;
    while (end < n && contact[end] != 0) ++end;
    if (end > begin + 1 && t_s[end - 1] - t_s[begin] >= config.min_run_s) {
      Run run;
      std::size_t i = begin;
      const auto cells = static_cast<std::size_t>((t_s[end - 1] - t_s[begin]) * kRate_hz);
      for (std::size_t c = 0; c < cells; ++c) {
        const double limit_s = t_s[begin] + static_cast<double>(c + 1) / kRate_hz;
        double h = 0.0, f = 0.0, count = 0.0;
        for (; i < end && (t_s[i] < limit_s || count == 0.0); ++i) {
          h += height_m[i];
          f += force_N[i];
          count += 1.0;
        }
        if (count == 0.0) break;
        run.height_m.push_back(h / count);
        run.force_N.push_back(f / count);
      }
      travelled_m += base.s_m[end - 1] - base.s_m[begin];
      out.used_s += t_s[end - 1] - t_s[begin];
      series.push_back(std::move(run));
    }
    begin = std::max(end, begin + 1);
  }
  if (series.empty()) {
    out.verdict = "no time in contact is long enough";
    return out;
  }
  out.band_high_hz = std::min(config.high_Hz, config.high_cycles_per_mm * 1e3 * travelled_m / out.used_s);
  for (const Run& run : series) {
    const double duration_s = static_cast<double>(run.height_m.size()) / kRate_hz;
    const auto height = real_dft(without_line(run.height_m)), force = real_dft(without_line(run.force_N));
    const auto last = std::min(static_cast<std::size_t>(out.band_high_hz * duration_s), height.size() - 1);
    Bins bins;
    for (std::size_t k = kFirstBin; k <= last; ++k) {
      bins.height.push_back(height[k]);
      bins.force.push_back(force[k]);
      // The taper's mean square is 3/8.
      square += 2.0 * std::norm(force[k]) / (0.375 * static_cast<double>(run.force_N.size()));
    }
    cells_used += run.force_N.size();
    runs.push_back(std::move(bins));
  }
  out.force_rms_N = std::sqrt(square / static_cast<double>(cells_used));
  const Slope slope = regress_bins(runs);
  if (!std::isfinite(slope.variance)) {
    out.verdict = "the recording is too short for the band below the texture";
    return out;
  }
  double sigma = std::sqrt(slope.variance);
  if (slope.compliance < -config.significance * sigma) {
    out.verdict = "height and force rise together below the texture's band: the relief hides any sinking";
    return out;
  }
  // No surface rises under the force: what the slope is below 0 by is an error that was seen.
  sigma = std::hypot(sigma, std::min(slope.compliance, 0.0));
  out.compliance_mm_per_N = 1e3 * slope.compliance;
  out.compliance_stderr_mm_per_N = 1e3 * sigma;
  out.degrees_of_freedom = slope.degrees_of_freedom;
  out.lower_bound_N_per_mm = 1e-3 / (std::max(slope.compliance, 0.0) + kBoundSigmas * sigma);
  out.measured = slope.compliance > config.significance * sigma;
  if (out.measured) {
    out.stiffness_N_per_mm = 1e-3 / slope.compliance;
    out.stiffness_stderr_N_per_mm = out.stiffness_N_per_mm * sigma / slope.compliance;
    // config.significance may be below 1.96: then there is no upper end.
    const double least = slope.compliance - kBoundSigmas * sigma;
    out.upper_bound_N_per_mm = least > 0.0 ? 1e-3 / least : std::numeric_limits<double>::infinity();
    out.verdict = "measured";
  } else {
    out.verdict = fmt::format("the force varied too little to show any sinking: at least {:.3g} N/mm (97.5 %)",
                              out.lower_bound_N_per_mm);
  }
  return out;
}

}  // namespace asperity
