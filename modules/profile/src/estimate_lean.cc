#include "estimate_lean.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "lean_bands.h"

namespace asperity {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree_rad = kPi / 180.0;
constexpr double kSlowestRate_Hz = 190.0;             // of a motion that an accelerometer has followed
constexpr double kAlignment_rad = 1.5 * kDegree_rad;  // of accelerometer and orientation against the base
constexpr double kNothing = 1e-9;
constexpr double kCoupled = 0.02;                 // how often tremor and texture have to do with each other after all
constexpr double kForce_rad = 3.0 * kDegree_rad;  // crosstalk of a force sensor's axes, 5 %
constexpr double kFewestForces = 50.0;
constexpr double kReach_rad = 60.0 * kDegree_rad;
constexpr int kSteps = 1201;           // of a tenth of a degree
constexpr double kLargestScale = 4.0;  // of the noise: it is known to this factor
constexpr int kScales = 9;

double angle_at(int k) { return kReach_rad * (2.0 * k / (kSteps - 1) - 1.0); }

// The covariance of a band along and across the normals that lean by φ: its mean coefficient's, less a constant factor.
struct Powers {
  double normal = 0.0, across = 0.0;                      // of texture and tremor, without the noise
  double all_normal = 0.0, all_across = 0.0, both = 0.0;  // with it
};

Powers powers_at(const BandPower& measured, const BandPower& noise, double scale) {
  Powers out;
  out.all_normal = std::max(measured.normal, scale * noise.normal);
  out.all_across = std::max(measured.across, scale * noise.across);
  out.both = scale * noise.both;
  out.normal = out.all_normal - scale * noise.normal;
  out.across = out.all_across - scale * noise.across;
  return out;
}

double log_likelihood(const LeanBand& band, double phi) {
  const BandPower measured = band.measured.turned(phi);
  if (!(band.noise.normal > 0.0)) return -band.count * (std::log(measured.normal * measured.across) + 2.0);
  const BandPower noise = band.noise.turned(phi);
  const auto value_at = [&](double scale) {
    const Powers all = powers_at(measured, noise, scale);
    const double det = all.all_normal * all.all_across - all.both * all.both;
    const double trace =
        (all.all_across * measured.normal + all.all_normal * measured.across - 2.0 * all.both * measured.both) / det;
    return -band.count * (std::log(det) + trace);
  };
  // Noise along one line is nearly singular: between the steps is the scale at which it leaves nothing correlated.
  const double even = measured.both / noise.both;
  double most = value_at(even > 0.0 ? std::clamp(even, 1.0 / kLargestScale, kLargestScale) : 1.0);
  for (int k = 0; k < kScales; ++k)
    most = std::max(most, value_at(std::pow(kLargestScale, 2.0 * k / (kScales - 1) - 1.0)));
  return most;
}

double log_likelihood(const std::vector<LeanBand>& bands, double phi) {
  double sum = 0.0;
  for (const LeanBand& band : bands) sum += log_likelihood(band, phi);
  return sum;
}

void normalise(std::vector<double>& density) {
  double sum = 0.0;
  for (const double d : density) sum += d;
  for (double& d : density) d /= sum;
}

// The likelihood of the grid's angles by one kind of bands, widened by what is wrong with all of them alike.
std::vector<double> widened_likelihood(const std::vector<LeanBand>& bands, double near_rad,
                                       double texture_axis_sigma_rad) {
  std::vector<double> sharp(kSteps);
  for (int k = 0; k < kSteps; ++k) sharp[static_cast<std::size_t>(k)] = log_likelihood(bands, angle_at(k));
  const double most = *std::max_element(sharp.begin(), sharp.end());
  for (double& density : sharp) density = std::exp(density - most);
  normalise(sharp);
  // A tip that goes sideways by γ of the texture turns a band by γ H/(H − W). Each band counts by its information on
  // the angle, which goes as (H − W)² over the product of the powers that are measured, noise and all.
  double information = 0.0, give = 0.0;
  for (const LeanBand& band : bands) {
    const Powers at = powers_at(band.measured.turned(near_rad), band.noise.turned(near_rad), 1.0);
    const double both = at.all_normal * at.all_across;
    if (!(both > 0.0)) continue;
    information += band.count * std::pow(at.normal - at.across, 2) / both;
    give += band.count * at.normal * at.normal / both;
  }
  const double sigma = std::hypot(
      kAlignment_rad, information > 0.0 ? std::sqrt(give / information) * texture_axis_sigma_rad : kReach_rad);
  const double step = angle_at(1) - angle_at(0);
  const int reach = std::min(kSteps, static_cast<int>(4.0 * sigma / step));
  std::vector<double> out(kSteps, 0.0);
  for (int k = 0; k < kSteps; ++k) {
    if (sharp[static_cast<std::size_t>(k)] < kNothing / kSteps) continue;
    for (int d = std::max(-reach, -k); d <= std::min(reach, kSteps - 1 - k); ++d) {
      const double x = d * step / sigma;
      out[static_cast<std::size_t>(k + d)] += sharp[static_cast<std::size_t>(k)] * std::exp(-0.5 * x * x);
    }
  }
  normalise(out);
  for (double& density : out) density = kCoupled / kSteps + (1.0 - kCoupled) * density;
  return out;
}

// Multiplies the density over the grid by what the bands say: those of the tremor and those of the texture.
void include_motion(const std::vector<LeanBand>& bands, double texture_axis_sigma_rad, std::vector<double>& density) {
  double near_rad = 0.0, most = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < kSteps; ++k) {
    const double value = log_likelihood(bands, angle_at(k)) + std::log(density[static_cast<std::size_t>(k)]);
    if (!(value > most)) continue;
    most = value;
    near_rad = angle_at(k);
  }
  for (const bool textured : {false, true}) {
    std::vector<LeanBand> kind;
    for (const LeanBand& band : bands) {
      const Powers at = powers_at(band.measured.turned(near_rad), band.noise.turned(near_rad), 1.0);
      if ((at.normal > at.across) == textured) kind.push_back(band);
    }
    if (kind.empty()) continue;
    const std::vector<double> likelihood = widened_likelihood(kind, near_rad, texture_axis_sigma_rad);
    for (std::size_t k = 0; k < density.size(); ++k) density[k] *= likelihood[k];
  }
}

// Mean and standard deviation over the grid.
Lean moments(const std::vector<double>& density) {
  double sum = 0.0, first = 0.0, second = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double d = density[static_cast<std::size_t>(k)], phi = angle_at(k);
    sum += d;
    first += d * phi;
    second += d * phi * phi;
  }
  Lean out;
  if (!(sum > 0.0)) return out;
  out.lean_rad = first / sum;
  out.sigma_rad = std::sqrt(std::max(second / sum - out.lean_rad * out.lean_rad, 0.0));
  return out;
}

// The change along the path, the mean lean being known: mean and standard deviation.
Lean find_change(const std::vector<LeanStretch>& stretches, const LeanBins& bins, double lean_rad, double sigma_rad) {
  constexpr int kAngles = 81;
  constexpr double kWide = 4.0;
  std::vector<double> at(kAngles), value(kAngles);
  for (int k = 0; k < kAngles; ++k) {
    const auto i = static_cast<std::size_t>(k);
    at[i] = sigma_rad * kWide * (2.0 * k / (kAngles - 1) - 1.0);
    value[i] = log_likelihood(find_lean_bands(stretches, bins, at[i]), lean_rad) - 0.5 * std::pow(at[i] / sigma_rad, 2);
  }
  const double most = *std::max_element(value.begin(), value.end());
  double sum = 0.0, first = 0.0, second = 0.0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double d = std::exp(value[k] - most);
    sum += d;
    first += d * at[k];
    second += d * at[k] * at[k];
  }
  const double mean = first / sum;
  return {mean, std::sqrt(std::max(second / sum - mean * mean, 0.0)), 0.0};
}

// By the force across travel, of a sensor with three axes.
void include_force(const TipMotion& motion, std::span<const double> t_s, std::span<const char> contact,
                   const PathEvidence& evidence, const BasePath& base, const LeanAxes& axes,
                   std::vector<double>& density) {
  double normal_N = 0.0, across_N = 0.0, forces = 0.0;
  for (std::size_t i = 0; i < motion.force_world_N.size() && i < contact.size(); ++i) {
    const Eigen::Vector3d& force_N = motion.force_world_N[i];
    if (contact[i] == 0 || !force_N.allFinite()) continue;
    if (evidence.weight[index_at(evidence.path, t_s[i])] == 0.0) continue;
    normal_N += base.n_world[i].dot(force_N);
    across_N += axes.across[i].dot(force_N);
    forces += 1.0;
  }
  if (forces < kFewestForces || !(normal_N > 0.0)) return;
  const double phi = std::atan2(across_N, normal_N);
  for (int k = 0; k < kSteps; ++k)
    density[static_cast<std::size_t>(k)] *= std::exp(-0.5 * std::pow((angle_at(k) - phi) / kForce_rad, 2));
}

}  // namespace

Lean estimate_lean(const TipMotion& motion, std::span<const double> t_s, std::span<const char> contact,
                   const PathEvidence& evidence, const BasePath& base, const LeanAxes& axes, const LeanPrior& prior) {
  if (!(prior.sigma_rad > 0.0)) return {};
  std::vector<double> known(kSteps);
  for (int k = 0; k < kSteps; ++k)
    known[static_cast<std::size_t>(k)] = std::exp(-0.5 * std::pow(angle_at(k) / prior.sigma_rad, 2));
  include_force(motion, t_s, contact, evidence, base, axes, known);

  const double rate_Hz = 1.0 / evidence.path.step_s;
  const bool followed = prior.texture_axis_sigma_rad > 0.0 && rate_Hz > kSlowestRate_Hz;
  const LeanBins bins = lean_bins(rate_Hz);
  const std::vector<LeanStretch> stretches =
      followed ? find_lean_stretches(motion, t_s, evidence, base, axes, bins) : std::vector<LeanStretch>{};
  Lean change{0.0, prior.change_sigma_rad, 0.0};
  Lean out = moments(known);
  if (!stretches.empty()) {
    // The mean lean, the change about it, and the mean again.
    for (int round = 0; round < 2; ++round) {
      std::vector<double> density = known;
      const std::vector<LeanBand> bands = find_lean_bands(stretches, bins, change.lean_rad);
      if (!bands.empty()) include_motion(bands, prior.texture_axis_sigma_rad, density);
      out = moments(density);
      if (!(prior.change_sigma_rad > 0.0)) break;
      if (round == 0) change = find_change(stretches, bins, out.lean_rad, prior.change_sigma_rad);
    }
  }
  out.change_rad = change.lean_rad;
  out.sigma_rad = std::hypot(out.sigma_rad, change.sigma_rad);
  return out;
}

}  // namespace asperity
