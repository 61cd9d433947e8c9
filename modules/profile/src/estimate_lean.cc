#include "estimate_lean.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>

namespace asperity {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree_rad = kPi / 180.0;
constexpr std::size_t kCells = 256;  // of one stretch: 1.28 s at 200 Hz
constexpr double kLowest_Hz = 4.0;   // below it a tracker's error moves the tip, more along its ray than across
constexpr double kHighest_Hz = 60.0;
constexpr double kBandRatio = 1.26;          // third octaves
constexpr double kFewestCoefficients = 3.0;  // independent coefficients of a band
constexpr double kSlowestRate_Hz = 190.0;    // of a motion that an accelerometer has followed
constexpr double kOverlapping = 0.5;         // independent coefficients for each of stretches that overlap by half
constexpr double kAlignment_rad = 1.5 * kDegree_rad;  // of accelerometer and orientation against the base
constexpr double kNothing = 1e-9;
constexpr double kCoupled = 0.02;                 // how often tremor and texture have to do with each other after all
constexpr double kForce_rad = 3.0 * kDegree_rad;  // crosstalk of a force sensor's axes, 5 %
constexpr double kFewestForces = 50.0;
constexpr double kReach_rad = 60.0 * kDegree_rad;
constexpr int kSteps = 1201;  // of a tenth of a degree

double angle_at(int k) { return kReach_rad * (2.0 * k / (kSteps - 1) - 1.0); }

// Sums over a band: of |a_n|², |a_b|² and Re(a_n a_b*).
struct Band {
  double normal = 0.0, across = 0.0, both = 0.0, count = 0.0;
  double along_normal(double phi) const {
    const double c = std::cos(phi), s = std::sin(phi);
    return c * c * normal + s * s * across + 2.0 * s * c * both;
  }
  double across_normal(double phi) const { return along_normal(phi + 0.5 * kPi); }
};

// A stretch of the motion: the sums of each bin, and how much the change of the lean goes with it.
struct Stretch {
  double change = 0.0;
  std::vector<Band> bins;  // from the lowest frequency on
};

// Accelerations of the cells over the base, between cells that moved in contact; runs of them.
struct MotionRun {
  std::vector<double> normal, across, change;
};

std::vector<MotionRun> find_runs(const PathEvidence& evidence, std::span<const double> t_s, const BasePath& base,
                                 const LeanAxes& axes) {
  const std::size_t cells = evidence.path.size();
  std::vector<double> rise(cells);
  std::vector<std::size_t> sample(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const auto at = std::lower_bound(t_s.begin(), t_s.end(), evidence.path.time_s(c));
    sample[c] = std::min(static_cast<std::size_t>(at - t_s.begin()), t_s.size() - 1);
    rise[c] = base.n_world[sample[c]].dot(evidence.path.p_m[c] - base.p_world_m[sample[c]]);
  }
  std::vector<MotionRun> out;
  bool open = false;
  for (std::size_t c = 1; c + 1 < cells; ++c) {
    if (evidence.weight[c - 1] == 0.0 || evidence.weight[c] == 0.0 || evidence.weight[c + 1] == 0.0) {
      open = false;
      continue;
    }
    if (!open) out.emplace_back();
    open = true;
    const auto& p = evidence.path.p_m;
    out.back().normal.push_back(rise[c + 1] - 2.0 * rise[c] + rise[c - 1]);
    out.back().across.push_back(axes.across[sample[c]].dot(p[c + 1] - 2.0 * p[c] + p[c - 1]));
    out.back().change.push_back(axes.change.empty() ? 0.0 : axes.change[sample[c]]);
  }
  return out;
}

// LeanBins of the frequencies that are looked at.
struct LeanBins {
  std::size_t first = 0, last = 0;
};

LeanBins bins_at(double rate_Hz) {
  const double bin_Hz = rate_Hz / static_cast<double>(kCells);
  return {static_cast<std::size_t>(std::ceil(kLowest_Hz / bin_Hz)),
          static_cast<std::size_t>(std::min(kHighest_Hz, 0.3 * rate_Hz) / bin_Hz)};
}

std::vector<Stretch> find_stretches(const std::vector<MotionRun>& runs, const LeanBins& bins) {
  std::vector<Stretch> out;
  for (const MotionRun& run : runs) {
    for (std::size_t begin = 0; begin + kCells <= run.normal.size(); begin += kCells / 2) {
      Stretch& stretch = out.emplace_back();
      for (std::size_t i = 0; i < kCells; ++i) stretch.change += run.change[begin + i] / static_cast<double>(kCells);
      for (std::size_t k = bins.first; k <= bins.last; ++k) {
        std::complex<double> n = 0.0, b = 0.0;
        for (std::size_t i = 0; i < kCells; ++i) {
          const double turn = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(kCells);
          const std::complex<double> wave = std::polar(1.0 - std::cos(turn), static_cast<double>(k) * turn);
          n += wave * run.normal[begin + i];
          b += wave * run.across[begin + i];
        }
        stretch.bins.push_back({std::norm(n), std::norm(b), std::real(n * std::conj(b)), kOverlapping});
      }
    }
  }
  return out;
}

// The sums over third octaves and all stretches, each turned by the change of the lean there.
std::vector<Band> find_bands(const std::vector<Stretch>& stretches, const LeanBins& bins, double change_rad) {
  std::vector<Band> out;
  double until = kBandRatio * static_cast<double>(bins.first);
  for (std::size_t k = bins.first; k <= bins.last; ++k) {
    const bool full = !out.empty() && out.back().count >= kFewestCoefficients && static_cast<double>(k) >= until;
    if (out.empty() || full) {
      out.emplace_back();
      until = kBandRatio * static_cast<double>(k);
    }
    Band& sum = out.back();
    for (const Stretch& stretch : stretches) {
      const Band& bin = stretch.bins[k - bins.first];
      const double phi = change_rad * stretch.change, c = std::cos(2.0 * phi), s = std::sin(2.0 * phi);
      sum.normal += bin.along_normal(phi);
      sum.across += bin.across_normal(phi);
      sum.both += c * bin.both + 0.5 * s * (bin.across - bin.normal);
      sum.count += bin.count;
    }
  }
  if (!out.empty() && out.back().count < kFewestCoefficients) out.pop_back();
  std::erase_if(out, [](const Band& band) { return !(band.normal > 0.0 && band.across > 0.0); });
  return out;
}

double log_likelihood(const std::vector<Band>& bands, double phi) {
  double sum = 0.0;
  for (const Band& band : bands) sum -= band.count * std::log(band.along_normal(phi) * band.across_normal(phi));
  return sum;
}

void normalise(std::vector<double>& density) {
  double sum = 0.0;
  for (const double d : density) sum += d;
  for (double& d : density) d /= sum;
}

// The likelihood of the grid's angles by one kind of bands, widened by what is wrong with all of them alike.
std::vector<double> widened_likelihood(const std::vector<Band>& bands, double near_rad, double texture_axis_sigma_rad) {
  std::vector<double> sharp(kSteps);
  for (int k = 0; k < kSteps; ++k) sharp[static_cast<std::size_t>(k)] = log_likelihood(bands, angle_at(k));
  const double most = *std::max_element(sharp.begin(), sharp.end());
  for (double& density : sharp) density = std::exp(density - most);
  normalise(sharp);
  // A tip that goes sideways by γ of the texture turns a band by γ H/(H − W). Each band counts by its information on
  // the angle, which goes as (H − W)²/(H W).
  double information = 0.0, give = 0.0;
  for (const Band& band : bands) {
    const double h = band.along_normal(near_rad), w = band.across_normal(near_rad);
    if (!(h > 0.0 && w > 0.0)) continue;
    information += band.count * (h - w) * (h - w) / (h * w);
    give += band.count * h / w;
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
void include_motion(const std::vector<Band>& bands, double texture_axis_sigma_rad, std::vector<double>& density) {
  double near_rad = 0.0, most = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < kSteps; ++k) {
    const double value = log_likelihood(bands, angle_at(k)) + std::log(density[static_cast<std::size_t>(k)]);
    if (!(value > most)) continue;
    most = value;
    near_rad = angle_at(k);
  }
  for (const bool textured : {false, true}) {
    std::vector<Band> kind;
    for (const Band& band : bands) {
      if ((band.along_normal(near_rad) > band.across_normal(near_rad)) == textured) kind.push_back(band);
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
Lean find_change(const std::vector<Stretch>& stretches, const LeanBins& bins, double lean_rad, double sigma_rad) {
  constexpr int kAngles = 81;
  constexpr double kWide = 4.0;
  std::vector<double> at(kAngles), value(kAngles);
  for (int k = 0; k < kAngles; ++k) {
    const auto i = static_cast<std::size_t>(k);
    at[i] = sigma_rad * kWide * (2.0 * k / (kAngles - 1) - 1.0);
    value[i] = log_likelihood(find_bands(stretches, bins, at[i]), lean_rad) - 0.5 * std::pow(at[i] / sigma_rad, 2);
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
  const LeanBins bins = bins_at(rate_Hz);
  const std::vector<Stretch> stretches =
      followed ? find_stretches(find_runs(evidence, t_s, base, axes), bins) : std::vector<Stretch>{};
  Lean change{0.0, prior.change_sigma_rad, 0.0};
  Lean out = moments(known);
  if (!stretches.empty()) {
    // The mean lean, the change about it, and the mean again.
    for (int round = 0; round < 2; ++round) {
      std::vector<double> density = known;
      const std::vector<Band> bands = find_bands(stretches, bins, change.lean_rad);
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
