#include "asperity/profile/estimate_friction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <Eigen/Core>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kTwoSided95 = 1.959963984540054;
constexpr double kDirection_s = 0.05;  // to either side: the direction of travel is that of a hand, not of the relief
constexpr double kSteepest = 1.0;      // slopes beyond it are impacts, not facets
constexpr double kSlideAfter_s = 1.0;  // a stick ends in sliding within this time, and begins so
constexpr std::array<double, 9> kDelays_s{0.0, 0.3e-3, 0.5e-3, 0.8e-3, 1.2e-3, 1.6e-3, 2.5e-3, 4e-3, 8e-3};

// What each sample says; nan where it says nothing.
struct Rubbing {
  std::vector<double> t_s, angle_rad, slope, speed_mps, along_mps, force_N;
  std::vector<char> touching;  // in contact, with enough force
};

// Mean of the tangential velocity over kDirection_s to either side.
std::vector<Eigen::Vector3d> hand_velocity(const Rubbing& r, const std::vector<Eigen::Vector3d>& tangential) {
  const std::size_t n = tangential.size();
  std::vector<Eigen::Vector3d> sum(n + 1, Eigen::Vector3d::Zero()), out(n);
  for (std::size_t i = 0; i < n; ++i) sum[i + 1] = sum[i] + tangential[i];
  std::size_t begin = 0, end = 0;
  for (std::size_t i = 0; i < n; ++i) {
    while (r.t_s[i] - r.t_s[begin] > kDirection_s) ++begin;
    while (end < n && r.t_s[end] - r.t_s[i] <= kDirection_s) ++end;
    out[i] = (sum[end] - sum[begin]) / static_cast<double>(end - begin);
  }
  return out;
}

Rubbing look_at_samples(const TipMotion& motion, const BasePath& path, std::span<const char> contact,
                        const FrictionConfig& config) {
  const std::size_t n = motion.size();
  Rubbing r;
  std::vector<Eigen::Vector3d> tangential(n);
  r.t_s.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    r.t_s[i] = static_cast<double>(motion.t_ns[i] - motion.t_ns[0]) * kNanosecond_s;
    const Eigen::Vector3d& v = motion.v_world_tip_mps[i];
    tangential[i] = v - path.n_world[i] * path.n_world[i].dot(v);
  }
  const std::vector<Eigen::Vector3d> hand = hand_velocity(r, tangential);
  r.angle_rad.assign(n, kNan);
  r.slope.assign(n, 0.0);
  r.speed_mps.resize(n);
  r.along_mps.resize(n);
  r.force_N.resize(n);
  r.touching.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const double speed_mps = hand[i].norm();
    r.speed_mps[i] = speed_mps;
    r.force_N[i] = path.n_world[i].dot(motion.force_world_N[i]);
    r.touching[i] = contact[i] != 0 && r.force_N[i] > config.min_force_N ? 1 : 0;
    if (!(speed_mps > 0.0)) continue;
    const Eigen::Vector3d t = hand[i] / speed_mps;
    r.along_mps[i] = t.dot(motion.v_world_tip_mps[i]);
    // A tip that is held at an edge has no slope: at least a third of the hand's speed counts.
    const double along_mps = std::max(r.along_mps[i], speed_mps / 3.0);
    r.slope[i] = std::clamp(path.n_world[i].dot(motion.v_world_tip_mps[i]) / along_mps, -kSteepest, kSteepest);
    r.angle_rad[i] = std::atan2(-t.dot(motion.force_world_N[i]), r.force_N[i]);
  }
  return r;
}

bool slides(const Rubbing& r, std::size_t i, const FrictionConfig& config) {
  return r.touching[i] != 0 && r.speed_mps[i] >= config.min_speed_mps && std::isfinite(r.angle_rad[i]);
}

// atan2(T, N) less the angle of the slope as a sensor with this time constant follows it; nan where the tip does not
// slide.
std::vector<double> friction_angles(const Rubbing& r, double delay_s, const FrictionConfig& config) {
  std::vector<double> out(r.t_s.size(), kNan);
  double late = 0.0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const bool begins = i == 0 || r.touching[i - 1] == 0;
    const double step_s = i == 0 ? 0.0 : r.t_s[i] - r.t_s[i - 1];
    late = begins || delay_s <= 0.0 ? r.slope[i] : late + (r.slope[i] - late) * -std::expm1(-step_s / delay_s);
    if (slides(r, i, config)) out[i] = r.angle_rad[i] - std::atan(late);
  }
  return out;
}

std::vector<double> finite_of(const std::vector<double>& x) {
  std::vector<double> out;
  std::copy_if(x.begin(), x.end(), std::back_inserter(out), [](double v) { return std::isfinite(v); });
  return out;
}

// Windows of sliding that follow one another without a break in contact, their medians and means.
struct Windows {
  std::vector<double> median_rad, mean_rad, speed_mps, force_N;
};

Windows cut_windows(const Rubbing& r, const std::vector<double>& angle_rad, const FrictionConfig& config) {
  Windows out;
  const std::size_t n = r.t_s.size();
  for (std::size_t begin = 0; begin < n;) {
    std::vector<double> angles;
    double speed_mps = 0.0, force_N = 0.0;
    std::size_t end = begin;
    while (end < n && r.t_s[end] - r.t_s[begin] < config.window_s) {
      if (std::isfinite(angle_rad[end])) {
        angles.push_back(angle_rad[end]);
        speed_mps += r.speed_mps[end];
        force_N += r.force_N[end];
      }
      ++end;
    }
    const auto count = static_cast<double>(angles.size());
    if (angles.size() >= 10 && count >= 0.5 * static_cast<double>(end - begin)) {
      out.median_rad.push_back(median(angles));
      out.mean_rad.push_back(mean(angles));
      out.speed_mps.push_back(speed_mps / count);
      out.force_N.push_back(force_N / count);
    }
    begin = end;
  }
  return out;
}

// Independent values among n whose residuals are correlated from one to the next (Bartlett 1946, first lag).
double independent_count(const std::vector<double>& residual) {
  double power = 0.0, lagged = 0.0;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    power += residual[i] * residual[i];
    if (i > 0) lagged += residual[i] * residual[i - 1];
  }
  const double rho = power > 0.0 ? std::clamp(lagged / power, 0.0, 0.95) : 0.0;
  return static_cast<double>(residual.size()) * (1.0 - rho) / (1.0 + rho);
}

struct LinearLaw {
  Eigen::VectorXd value, standard_error;
  double residual_power = 0.0;
};

LinearLaw fit_law(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y) {
  LinearLaw out;
  const Eigen::MatrixXd information = columns.transpose() * columns;
  const Eigen::MatrixXd inverse = inverse_of(information);
  out.value = inverse * columns.transpose() * y;
  const Eigen::VectorXd residual = y - columns * out.value;
  out.residual_power = residual.squaredNorm();
  const double n = independent_count({residual.begin(), residual.end()});
  const double freedom = std::max(1.0, n - static_cast<double>(columns.cols()));
  const double variance = out.residual_power / static_cast<double>(y.size()) * n / freedom;
  out.standard_error = (inverse.diagonal() * variance * static_cast<double>(y.size()) / n).cwiseMax(0.0).cwiseSqrt();
  return out;
}

// How the coefficient goes with speed and force. A plane through three windows has no residual, and so no error.
void fit_slopes(FrictionEstimate& out) {
  const auto n = static_cast<Eigen::Index>(out.windows.size());
  if (n <= 3) return;
  Eigen::MatrixXd columns(n, 3);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const FrictionWindow& window = out.windows[static_cast<std::size_t>(i)];
    columns.row(i) << 1.0, window.speed_mps - out.speed_mps, std::log(window.force_N / out.force_N);
    y[i] = window.coefficient;
  }
  const Eigen::MatrixXd about_mean = columns.rightCols(2).rowwise() - columns.rightCols(2).colwise().mean();
  const Eigen::Vector2d spread = about_mean.colwise().norm();
  const double cosine = about_mean.col(0).dot(about_mean.col(1)) / (spread[0] * spread[1]);
  if (!(spread[0] > 0.0) || !(spread[1] > 0.0) || !(std::abs(cosine) < 0.99)) return;
  const LinearLaw law = fit_law(columns, y);
  out.per_mps = law.value[1];
  out.per_mps_stderr = law.standard_error[1];
  out.per_log_force = law.value[2];
  out.per_log_force_stderr = law.standard_error[2];
}

// Stribeck's law where the speeds span a factor of three and the data ask for it: Schwarz's criterion against a
// constant, by the independent windows less the law's three parameters: few windows are followed by any law.
void fit_stribeck(FrictionEstimate& out) {
  constexpr double kSpan = 3.0, kEvidence = 10.0;  // "very strong" (Kass and Raftery 1995)
  const auto [slowest, fastest] =
      std::minmax_element(out.windows.begin(), out.windows.end(),
                          [](const FrictionWindow& a, const FrictionWindow& b) { return a.speed_mps < b.speed_mps; });
  if (!(fastest->speed_mps > kSpan * slowest->speed_mps)) return;
  const auto n = static_cast<Eigen::Index>(out.windows.size());
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) y[i] = out.windows[static_cast<std::size_t>(i)].coefficient;
  const Eigen::VectorXd about_mean = y.array() - y.mean();
  double best_power = about_mean.squaredNorm();
  StribeckLaw best;
  Eigen::VectorXd residual = about_mean;
  for (double speed_mps = 0.5 * slowest->speed_mps; speed_mps < fastest->speed_mps; speed_mps *= 1.2) {
    Eigen::MatrixXd columns(n, 2);
    for (Eigen::Index i = 0; i < n; ++i)
      columns.row(i) << 1.0, std::exp(-out.windows[static_cast<std::size_t>(i)].speed_mps / speed_mps);
    const LinearLaw law = fit_law(columns, y);
    if (!(law.value[1] > 0.0) || !(law.residual_power < best_power)) continue;
    best_power = law.residual_power;
    best = {law.value[0] + law.value[1], law.value[0], speed_mps};
    residual = y - columns * law.value;
  }
  if (std::isnan(best.speed_mps)) return;
  constexpr double kParameters = 3.0;
  const double independent = independent_count({residual.begin(), residual.end()});
  if (!(independent > kParameters)) return;
  const double evidence =
      (independent - kParameters) * std::log(about_mean.squaredNorm() / best_power) - 2.0 * std::log(independent);
  if (evidence > kEvidence) out.stribeck = best;
}

// Times at which the tip is held, between times of sliding.
void find_sticks(const Rubbing& r, const FrictionConfig& config, FrictionEstimate& out) {
  const std::size_t n = r.t_s.size();
  double stuck_s = 0.0, contact_s = 0.0, slid_at_s = -1.0;
  std::vector<double> breakaways;
  for (std::size_t i = 0; i < n; ++i) {
    if (r.touching[i] == 0) {
      slid_at_s = -1.0;
      continue;
    }
    if (i > 0) contact_s += r.t_s[i] - r.t_s[i - 1];
    if (std::abs(r.along_mps[i]) >= config.min_speed_mps) slid_at_s = r.t_s[i];
    if (std::abs(r.along_mps[i]) >= config.stick_speed_mps || slid_at_s < 0.0) continue;
    std::size_t end = i;
    while (end < n && r.touching[end] != 0 && std::abs(r.along_mps[end]) < config.stick_speed_mps) ++end;
    const double length_s = r.t_s[end - 1] - r.t_s[i];
    std::size_t slide = end;
    while (slide < n && r.touching[slide] != 0 && std::abs(r.along_mps[slide]) < config.min_speed_mps &&
           r.t_s[slide] - r.t_s[end - 1] < kSlideAfter_s) {
      ++slide;
    }
    const bool ends_in_sliding = slide < n && std::abs(r.along_mps[slide]) >= config.min_speed_mps;
    if (length_s >= config.min_stick_s && length_s < kSlideAfter_s && ends_in_sliding &&
        r.t_s[i] - slid_at_s < kSlideAfter_s) {
      ++out.sticks;
      stuck_s += length_s;
      if (std::isfinite(r.angle_rad[end - 1])) breakaways.push_back(std::tan(r.angle_rad[end - 1]));
    }
    if (end > i + 1) {
      contact_s += length_s;
      i = end - 1;
    }
  }
  out.stuck_share = contact_s > 0.0 ? stuck_s / contact_s : 0.0;
  if (breakaways.size() < 3) return;
  const double error = standard_deviation(breakaways) / std::sqrt(static_cast<double>(breakaways.size()));
  if (!(error <= config.max_stderr)) return;
  out.breakaway = mean(breakaways);
  out.breakaway_stderr = error;
}

// What the tip has to overcome at rest, over what it feels while it slides. A tip that slides has overcome it: no ratio
// is below 1.
void find_static_ratio(FrictionEstimate& out) {
  if (std::isfinite(out.breakaway)) {
    out.static_ratio = std::max(1.0, out.breakaway / out.coefficient);
    out.static_ratio_stderr = out.breakaway / out.coefficient *
                              std::hypot(out.breakaway_stderr / out.breakaway, out.standard_error / out.coefficient);
  } else if (out.stribeck) {
    out.static_ratio = std::max(1.0, out.stribeck->at_rest / out.coefficient);
  }
}

}  // namespace

FrictionEstimate estimate_friction(const TipMotion& motion, const BasePath& path, std::span<const char> contact,
                                   const FrictionConfig& config) {
  const std::size_t n = motion.size();
  FrictionEstimate out;
  if (motion.force_world_N.empty()) {
    out.verdict = "not measured: friction needs a force sensor of three axes";
    return out;
  }
  if (motion.force_world_N.size() != n || motion.v_world_tip_mps.size() != n || path.n_world.size() != n ||
      contact.size() != n) {
    throw Error("friction: motion, force, base path and contact differ in size (" + std::to_string(n) + " samples)");
  }
  if (n == 0) {
    out.verdict = "not measured: there is no motion";
    return out;
  }
  const Rubbing rubbing = look_at_samples(motion, path, contact, config);
  find_sticks(rubbing, config, out);

  std::vector<double> angle_rad;
  for (const double delay_s : kDelays_s) {
    std::vector<double> tried = friction_angles(rubbing, delay_s, config);
    const std::vector<double> known = finite_of(tried);
    if (known.empty()) break;
    const double spread = percentile(known, 75.0) - percentile(known, 25.0);
    if (std::isfinite(out.spread_rad) && !(spread < out.spread_rad)) continue;
    out.spread_rad = spread;
    out.sensor_delay_s = delay_s;
    angle_rad = std::move(tried);
  }
  const Windows windows = angle_rad.empty() ? Windows{} : cut_windows(rubbing, angle_rad, config);
  const std::size_t count = windows.median_rad.size();
  if (count < static_cast<std::size_t>(config.min_windows)) {
    out.verdict = fmt::format("not determined: the tip slid in contact for {} windows of {:.2g} s, {} are needed",
                              count, config.window_s, config.min_windows);
    return out;
  }
  for (std::size_t i = 0; i < count; ++i)
    out.windows.push_back({std::tan(windows.median_rad[i]), windows.speed_mps[i], windows.force_N[i]});
  const double angle = median(windows.median_rad);
  out.coefficient = std::tan(angle);
  out.speed_mps = median(windows.speed_mps);
  out.force_N = median(windows.force_N);

  std::vector<double> residual;
  for (const double a : windows.median_rad) residual.push_back(a - angle);
  constexpr double kMedianLoss = 1.5707963267948966;  // of a median's variance over a mean's, Gaussian
  const double scatter_rad = std::sqrt(kMedianLoss * variance(residual) / independent_count(residual));
  const double edges_rad = 2.0 * std::abs(mean(windows.mean_rad) - mean(windows.median_rad));
  const double offset = config.offset_sigma_N / out.force_N;
  const double per_rad = 1.0 + out.coefficient * out.coefficient;
  out.standard_error = std::hypot(std::hypot(per_rad * scatter_rad, per_rad * edges_rad),
                                  std::hypot(per_rad * config.alignment_sigma_rad, offset));
  out.low = std::max(0.0, out.coefficient - kTwoSided95 * out.standard_error);
  out.high = out.coefficient + kTwoSided95 * out.standard_error;
  fit_slopes(out);
  fit_stribeck(out);

  const double allowed = std::max(config.max_stderr, 0.25 * out.coefficient);
  if (!(out.standard_error <= allowed)) {
    out.verdict = fmt::format(
        "not determined: the standard error is {:.2g}, more than {:.2g}; {}", out.standard_error, allowed,
        edges_rad * per_rad > 0.5 * out.standard_error ? "the tip runs against edges: slide over a smoother part"
                                                       : "slide longer, and with more force");
  } else if (out.high <= 0.0) {
    out.verdict = "not determined: the force along the surface is not against the motion; check the sensor's axes";
  } else {
    out.determined = true;
    out.verdict = "determined";
    find_static_ratio(out);
  }
  return out;
}

}  // namespace asperity
