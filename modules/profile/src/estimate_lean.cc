#include "estimate_lean.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
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
constexpr double kCoupled = 0.1;                  // how often tremor and texture have to do with each other after all
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

// Accelerations of the cells over the base, between cells that moved in contact; runs of them.
struct MotionRun {
  std::vector<double> normal, across;
};

std::vector<MotionRun> find_runs(const PathEvidence& evidence, std::span<const double> t_s, const BasePath& base,
                                 std::span<const Eigen::Vector3d> across) {
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
    out.back().across.push_back(across[sample[c]].dot(p[c + 1] - 2.0 * p[c] + p[c - 1]));
  }
  return out;
}

std::vector<Band> find_bands(const std::vector<MotionRun>& runs, double rate_Hz) {
  const double bin_Hz = rate_Hz / static_cast<double>(kCells);
  const auto first = static_cast<std::size_t>(std::ceil(kLowest_Hz / bin_Hz));
  const auto last = static_cast<std::size_t>(std::min(kHighest_Hz, 0.3 * rate_Hz) / bin_Hz);
  std::vector<Band> bins(last + 1);
  for (const MotionRun& run : runs) {
    for (std::size_t begin = 0; begin + kCells <= run.normal.size(); begin += kCells / 2) {
      for (std::size_t k = first; k <= last; ++k) {
        std::complex<double> n = 0.0, b = 0.0;
        for (std::size_t i = 0; i < kCells; ++i) {
          const double turn = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(kCells);
          const std::complex<double> wave = std::polar(1.0 - std::cos(turn), static_cast<double>(k) * turn);
          n += wave * run.normal[begin + i];
          b += wave * run.across[begin + i];
        }
        bins[k].normal += std::norm(n);
        bins[k].across += std::norm(b);
        bins[k].both += std::real(n * std::conj(b));
        bins[k].count += kOverlapping;
      }
    }
  }
  std::vector<Band> out;
  double until = kBandRatio * static_cast<double>(first);
  for (std::size_t k = first; k <= last; ++k) {
    const bool full = !out.empty() && out.back().count >= kFewestCoefficients && static_cast<double>(k) >= until;
    if (out.empty() || full) {
      out.emplace_back();
      until = kBandRatio * static_cast<double>(k);
    }
    out.back().normal += bins[k].normal;
    out.back().across += bins[k].across;
    out.back().both += bins[k].both;
    out.back().count += bins[k].count;
  }
  if (!out.empty() && out.back().count < kFewestCoefficients) out.pop_back();
  std::erase_if(out, [](const Band& band) { return !(band.normal > 0.0 && band.across > 0.0); });
  return out;
}

void normalise(std::vector<double>& density) {
  double sum = 0.0;
  for (const double d : density) sum += d;
  for (double& d : density) d /= sum;
}

// The likelihood of the grid's angles by the bands, sum 1.
std::vector<double> motion_likelihood(const std::vector<Band>& bands, double texture_axis_sigma_rad) {
  std::vector<double> log_density(kSteps, 0.0);
  for (int k = 0; k < kSteps; ++k) {
    const double phi = angle_at(k);
    for (const Band& band : bands) {
      log_density[static_cast<std::size_t>(k)] -=
          band.count * std::log(band.along_normal(phi) * band.across_normal(phi));
    }
  }
  const auto best = std::max_element(log_density.begin(), log_density.end());
  const double phi = angle_at(static_cast<int>(best - log_density.begin())), most = *best;
  std::vector<double> sharp(kSteps);
  for (std::size_t k = 0; k < sharp.size(); ++k) sharp[k] = std::exp(log_density[k] - most);
  normalise(sharp);

  // The information of a band, as far as the texture or the tremor is the stronger.
  double information = 0.0, textured = 0.0;
  for (const Band& band : bands) {
    const double h = band.along_normal(phi), w = band.across_normal(phi);
    if (!(h > 0.0 && w > 0.0)) continue;
    const double one = band.count * (h - w) * (h - w) / (h * w);
    information += one;
    textured += one * h / (h + w);
  }
  const double share = information > 0.0 ? textured / information : 0.0;
  const double sigma = std::hypot(kAlignment_rad, std::sqrt(share) * texture_axis_sigma_rad);
  const double step = angle_at(1) - angle_at(0);
  const int reach = static_cast<int>(4.0 * sigma / step);
  std::vector<double> out(kSteps, 0.0);
  for (int k = 0; k < kSteps; ++k) {
    for (int d = std::max(-reach, -k); d <= std::min(reach, kSteps - 1 - k); ++d) {
      const double x = d * step / sigma;
      out[static_cast<std::size_t>(k + d)] += sharp[static_cast<std::size_t>(k)] * std::exp(-0.5 * x * x);
    }
  }
  normalise(out);
  for (double& density : out) density = kCoupled / kSteps + (1.0 - kCoupled) * density;
  return out;
}

}  // namespace

Lean estimate_lean(const TipMotion& motion, std::span<const double> t_s, std::span<const char> contact,
                   const PathEvidence& evidence, const BasePath& base, std::span<const Eigen::Vector3d> across,
                   const LeanPrior& prior) {
  if (!(prior.sigma_rad > 0.0)) return {};
  std::vector<double> density(kSteps);
  for (int k = 0; k < kSteps; ++k) {
    density[static_cast<std::size_t>(k)] = std::exp(-0.5 * std::pow(angle_at(k) / prior.sigma_rad, 2));
  }
  const double rate_Hz = 1.0 / evidence.path.step_s;
  if (prior.texture_axis_sigma_rad > 0.0 && rate_Hz > kSlowestRate_Hz) {
    const std::vector<Band> bands = find_bands(find_runs(evidence, t_s, base, across), rate_Hz);
    if (!bands.empty()) {
      const std::vector<double> likelihood = motion_likelihood(bands, prior.texture_axis_sigma_rad);
      for (std::size_t k = 0; k < density.size(); ++k) density[k] *= likelihood[k];
    }
  }
  double normal_N = 0.0, across_N = 0.0, forces = 0.0;
  for (std::size_t i = 0; i < motion.force_world_N.size() && i < contact.size(); ++i) {
    const Eigen::Vector3d& force_N = motion.force_world_N[i];
    if (contact[i] == 0 || !force_N.allFinite()) continue;
    if (evidence.weight[index_at(evidence.path, t_s[i])] == 0.0) continue;
    normal_N += base.n_world[i].dot(force_N);
    across_N += across[i].dot(force_N);
    forces += 1.0;
  }
  if (forces >= kFewestForces && normal_N > 0.0) {
    const double phi = std::atan2(across_N, normal_N);
    for (int k = 0; k < kSteps; ++k) {
      density[static_cast<std::size_t>(k)] *= std::exp(-0.5 * std::pow((angle_at(k) - phi) / kForce_rad, 2));
    }
  }
  double sum = 0.0, first = 0.0, second = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double d = density[static_cast<std::size_t>(k)], phi = angle_at(k);
    sum += d;
    first += d * phi;
    second += d * phi * phi;
  }
  if (!(sum > 0.0)) return {0.0, prior.sigma_rad};
  Lean out;
  out.lean_rad = first / sum;
  out.sigma_rad = std::sqrt(std::max(second / sum - out.lean_rad * out.lean_rad, 0.0));
  return out;
}

}  // namespace asperity
