#include "lean_bands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "asperity/signal/spectrum.h"

namespace asperity {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kCells = 256;  // of one stretch: 1.28 s at 200 Hz
constexpr double kLowest_Hz = 4.0;   // below it a tracker's error moves the tip, more along its ray than across
constexpr double kHighest_Hz = 60.0;
constexpr double kBandRatio = 1.26;          // third octaves
constexpr double kFewestCoefficients = 3.0;  // independent coefficients of a band
constexpr double kOverlapping = 0.5;         // independent coefficients for each of stretches that overlap by half
constexpr double kWindowPower = 1.5;         // mean square of 1 − cos

constexpr double kLastTurn = 0.9;  // of half the rate: the highest frequency of the turning that is looked at

// Of the cells over the base, between cells that moved in contact; runs of them. With l from the sensor to the tip:
// what the probe's rotation until the next cell moves the tip by, along n and b, and |l|² − l lᵀ, along n n, b b and n
// b.
struct MotionRun {
  std::vector<double> normal, across, change, turn_normal, turn_across;
  std::vector<BandPower> lever_m2;
};

std::vector<MotionRun> find_runs(const TipMotion& motion, const PathEvidence& evidence, std::span<const double> t_s,
                                 const BasePath& base, const LeanAxes& axes) {
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
    const Eigen::Vector3d& across = axes.across[sample[c]];
    out.back().normal.push_back(rise[c + 1] - 2.0 * rise[c] + rise[c - 1]);
    out.back().across.push_back(across.dot(p[c + 1] - 2.0 * p[c] + p[c - 1]));
    out.back().change.push_back(axes.change.empty() ? 0.0 : axes.change[sample[c]]);
    const Eigen::Vector3d lever_m = motion.q_world_marker[sample[c]] * motion.noise.tip_from_sensor_m;
    const Eigen::Quaterniond turn = motion.q_world_marker[sample[c + 1]] * motion.q_world_marker[sample[c]].conjugate();
    const Eigen::Vector3d turned_m = (turn.w() < 0.0 ? -2.0 : 2.0) * turn.vec().cross(lever_m);
    out.back().turn_normal.push_back(base.n_world[sample[c]].dot(turned_m));
    out.back().turn_across.push_back(across.dot(turned_m));
    const double n_m = lever_m.dot(base.n_world[sample[c]]), b_m = lever_m.dot(across), all_m2 = lever_m.squaredNorm();
    out.back().lever_m2.push_back({all_m2 - n_m * n_m, all_m2 - b_m * b_m, -n_m * b_m});
  }
  return out;
}

// 1 − cos over a window.
const std::array<double, kCells>& hann() {
  static const std::array<double, kCells> window = [] {
    std::array<double, kCells> w{};
    for (std::size_t i = 0; i < kCells; ++i)
      w[i] = 1.0 - std::cos(2.0 * kPi * static_cast<double>(i) / static_cast<double>(kCells));
    return w;
  }();
  return window;
}

std::vector<std::complex<double>> window_spectrum(const std::vector<double>& signal, std::size_t begin) {
  std::array<double, kCells> windowed{};
  for (std::size_t i = 0; i < kCells; ++i) windowed[i] = hann()[i] * signal[begin + i];
  return real_dft(windowed);
}

// The powers of a window's bins, from zero to half the rate.
std::vector<BandPower> bin_powers(const std::vector<double>& normal, const std::vector<double>& across,
                                  std::size_t begin) {
  const std::vector<std::complex<double>> n = window_spectrum(normal, begin), b = window_spectrum(across, begin);
  std::vector<BandPower> out(n.size());
  for (std::size_t k = 0; k < n.size(); ++k)
    out[k] = {std::norm(n[k]), std::norm(b[k]), std::real(n[k] * std::conj(b[k]))};
  return out;
}

// Calls `use(run, begin)` for each window.
template <class Use>
double over_windows(const std::vector<MotionRun>& runs, const Use& use) {
  double windows = 0.0;
  for (const MotionRun& run : runs) {
    for (std::size_t begin = 0; begin + kCells <= run.normal.size(); begin += kCells / 2, windows += 1.0)
      use(run, begin);
  }
  return windows;
}

// Means over all windows of what the probe's rotation moves the tip by: of each bin the least third octave that begins
// between it and twice its frequency.
std::vector<BandPower> turning_floor(const std::vector<MotionRun>& runs, const LeanBins& bins) {
  const auto highest = static_cast<std::size_t>(kLastTurn * 0.5 * static_cast<double>(kCells));
  const std::size_t end = std::max(
      bins.last + 1, std::min(highest, static_cast<std::size_t>(kBandRatio * 2.0 * static_cast<double>(bins.last))));
  std::vector<BandPower> mean(end);
  const double windows = over_windows(runs, [&](const MotionRun& run, std::size_t begin) {
    const std::vector<BandPower> power = bin_powers(run.turn_normal, run.turn_across, begin);
    for (std::size_t k = bins.first; k < end; ++k) mean[k] += power[k];
  });
  for (BandPower& power : mean) power = power.times(windows > 0.0 ? 1.0 / windows : 0.0);

  std::vector<BandPower> octave(end), out(end);
  for (std::size_t k = bins.first; k < end; ++k) {
    const std::size_t until = std::min(end, static_cast<std::size_t>(kBandRatio * static_cast<double>(k)) + 1);
    for (std::size_t i = k; i < until; ++i) octave[k] += mean[i].times(1.0 / static_cast<double>(until - k));
  }
  for (std::size_t k = bins.first; k <= bins.last; ++k) {
    out[k] = octave[k];
    for (std::size_t i = k; i <= 2 * k && kBandRatio * static_cast<double>(i) < static_cast<double>(end); ++i) {
      if (octave[i].normal + octave[i].across < out[k].normal + out[k].across) out[k] = octave[i];
    }
  }
  return out;
}

// What each bin is expected to hold of noise, as a mean over the windows.
std::vector<BandPower> find_noise(const MotionNoise& noise, const std::vector<MotionRun>& runs, const LeanBins& bins,
                                  double step_s) {
  if (!(noise.accel_m2ps3 > 0.0)) return std::vector<BandPower>(bins.last + 1);
  BandPower lever_m2;
  const double windows = over_windows(runs, [&](const MotionRun& run, std::size_t begin) {
    for (std::size_t i = 0; i < kCells; ++i)
      lever_m2 += run.lever_m2[begin + i].times(1.0 / static_cast<double>(kCells));
  });
  std::vector<BandPower> out = turning_floor(runs, bins);
  for (std::size_t k = bins.first; k <= bins.last; ++k) {
    const double x = kPi * static_cast<double>(k) / static_cast<double>(kCells), omega = 2.0 * x / step_s;
    // Means over cells, and second differences of them: sinc each, and so the first ones of the rotation's steps.
    const double sinc = std::sin(x) / x;
    const double each =
        0.5 / step_s * kWindowPower * static_cast<double>(kCells) * std::pow(sinc, 6) * std::pow(step_s, 4);
    BandPower turning = out[k].times(4.0 * std::pow(std::sin(x), 2) * std::pow(sinc, 4));
    // Without a gyroscope there is no rotation to be seen above the tracker's rate of it: the error is all of it.
    if (noise.rotation_accel_rad2ps5 > 0.0) {
      const double unseen = noise.rotation_accel_rad2ps5, seen = std::pow(omega, 4) * noise.rotation_rad2ps;
      turning = lever_m2.times(each / windows * (seen > 0.0 ? unseen * seen / (unseen + seen) : unseen));
    }
    out[k] = turning;
    out[k] += BandPower{each * noise.accel_m2ps3, each * noise.accel_m2ps3, 0.0};
  }
  return out;
}

}  // namespace

double BandPower::along_normal(double phi) const {
  const double c = std::cos(phi), s = std::sin(phi);
  return c * c * normal + s * s * across + 2.0 * s * c * both;
}

double BandPower::across_normal(double phi) const { return along_normal(phi + 0.5 * kPi); }

double BandPower::both_at(double phi) const {
  return std::cos(2.0 * phi) * both + 0.5 * std::sin(2.0 * phi) * (across - normal);
}

BandPower BandPower::times(double factor) const { return {factor * normal, factor * across, factor * both}; }

BandPower& BandPower::operator+=(const BandPower& other) {
  normal += other.normal;
  across += other.across;
  both += other.both;
  return *this;
}

LeanBins lean_bins(double rate_Hz) {
  const double bin_Hz = rate_Hz / static_cast<double>(kCells);
  return {static_cast<std::size_t>(std::ceil(kLowest_Hz / bin_Hz)),
          static_cast<std::size_t>(std::min(kHighest_Hz, 0.3 * rate_Hz) / bin_Hz)};
}

std::vector<LeanStretch> find_lean_stretches(const TipMotion& motion, std::span<const double> t_s,
                                             const PathEvidence& evidence, const BasePath& base, const LeanAxes& axes,
                                             const LeanBins& bins) {
  const std::vector<MotionRun> runs = find_runs(motion, evidence, t_s, base, axes);
  const std::vector<BandPower> noise = find_noise(motion.noise, runs, bins, evidence.path.step_s);
  std::vector<LeanStretch> out;
  over_windows(runs, [&](const MotionRun& run, std::size_t begin) {
    LeanStretch& stretch = out.emplace_back();
    for (std::size_t i = 0; i < kCells; ++i) stretch.change += run.change[begin + i] / static_cast<double>(kCells);
    const std::vector<BandPower> power = bin_powers(run.normal, run.across, begin);
    for (std::size_t k = bins.first; k <= bins.last; ++k) stretch.bins.push_back({power[k], noise[k], kOverlapping});
  });
  return out;
}

std::vector<LeanBand> find_lean_bands(const std::vector<LeanStretch>& stretches, const LeanBins& bins,
                                      double change_rad) {
  std::vector<LeanBand> out;
  double until = kBandRatio * static_cast<double>(bins.first);
  for (std::size_t k = bins.first; k <= bins.last; ++k) {
    const bool full = !out.empty() && out.back().count >= kFewestCoefficients && static_cast<double>(k) >= until;
    if (out.empty() || full) {
      out.emplace_back();
      until = kBandRatio * static_cast<double>(k);
    }
    LeanBand& sum = out.back();
    for (const LeanStretch& stretch : stretches) {
      const LeanBand& bin = stretch.bins[k - bins.first];
      const double phi = change_rad * stretch.change;
      sum.measured += bin.measured.turned(phi);
      sum.noise += bin.noise.turned(phi);
      sum.count += bin.count;
    }
  }
  if (!out.empty() && out.back().count < kFewestCoefficients) out.pop_back();
  std::erase_if(out, [](const LeanBand& band) { return !(band.measured.normal > 0.0 && band.measured.across > 0.0); });
  return out;
}

}  // namespace asperity
