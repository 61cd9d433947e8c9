// What share of the best possible correlation the product reaches: its heights against those of an oracle that knows
// the true spectra (docs/accuracy-oracle.md).
//
//   oracle [--scans 4] [--seed 1] [--simulator ours|second] [--probes what] [--families …] [--speed 0.025]
//
// The oracle gets the same channels along the surface's normal: the tip by the tracker's poses (one density R), the
// acceleration of the tip (A), and the force. It knows the surface's density S, each channel's error density as it is
// in this very scan, and the impedance that relates force to height, m(2πf)² …, fitted to the truth. Its height is the
// best linear estimate from the channels as if their errors did not depend on one another; the position along the path
// is the true one, or, as no recording contains that, the product's. Calibration exact. "of A and R": without the
// force, which is what `fused` uses.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <exception>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/geometry/pose.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"
#include "coverage/fft.h"
#include "coverage/scan_case.h"
#include "read_options.h"

namespace {

using Complex = std::complex<double>;
using Spectrum = std::vector<Complex>;

// One channel on the even grid of the stretch in contact, mirrored, so that its ends meet.
class Grid {
 public:
  Grid(double begin_s, double end_s, double rate_Hz) : begin_s_(begin_s), span_s_(end_s - begin_s) {
    while (static_cast<double>(half_) < span_s_ * rate_Hz) half_ *= 2;
  }
  double frequency_Hz(std::size_t k) const { return static_cast<double>(k) / (2.0 * span_s_); }
  std::size_t size() const { return half_; }

  Spectrum transform(const std::vector<double>& t_s, const std::vector<double>& x) const {
    std::vector<double> at_s(half_);
    for (std::size_t i = 0; i < half_; ++i) at_s[i] = begin_s_ + (static_cast<double>(i) + 0.5) * step_s();
    std::vector<double> y = asperity::interpolate(t_s, x, at_s, 1e9);
    Spectrum out(2 * half_);
    for (std::size_t i = 0; i < half_; ++i) out[i] = out[2 * half_ - 1 - i] = std::isfinite(y[i]) ? y[i] : 0.0;
    bench::fft(out, -1);
    return out;
  }
  std::vector<double> back(Spectrum x, const std::vector<double>& t_s) const {
    bench::fft(x, 1);
    std::vector<double> at_s(half_), y(half_);
    for (std::size_t i = 0; i < half_; ++i) {
      at_s[i] = begin_s_ + (static_cast<double>(i) + 0.5) * step_s();
      y[i] = x[i].real() / static_cast<double>(2 * half_);
    }
    return asperity::interpolate(at_s, y, t_s, 1e9);
  }

 private:
  double step_s() const { return span_s_ / static_cast<double>(half_); }
  double begin_s_, span_s_;
  std::size_t half_ = 64;
};

// Power smoothed over a third of an octave, at least nine lines.
std::vector<double> density(const Spectrum& x, std::size_t lines) {
  std::vector<double> sum(lines + 1, 0.0), out(lines);
  for (std::size_t k = 0; k < lines; ++k) sum[k + 1] = sum[k] + std::norm(x[k]);
  for (std::size_t k = 0; k < lines; ++k) {
    const std::size_t reach = std::max<std::size_t>(4, static_cast<std::size_t>(0.12 * static_cast<double>(k)));
    const std::size_t a = k > reach ? k - reach : 0, b = std::min(lines, k + reach + 1);
    out[k] = (sum[b] - sum[a]) / static_cast<double>(b - a);
  }
  return out;
}

struct Channel {
  Spectrum measured;
  std::vector<double> gain;  // of the height, real: all are even about the stretch's ends
};

struct Shares {
  double product, own_heights, two_noises, without_force, without_force_at_own, with_force, length_error_percent;
};

// On the surface's length, as the result beside it has it: `on_surface` is surface's over tip's.
double correlation(const asperity::Recording& recording, const asperity::TipMotion& motion, double on_surface) {
  asperity::BasePathResult base = asperity::find_base_path(motion, recording.calibration.tip_in_marker_m, {});
  for (double& s_m : base.path.s_m) s_m *= on_surface;
  const asperity::Profile profile = asperity::make_profile(motion, base.path, base.contact, {});
  return asperity::measure_accuracy(recording, motion, profile, {}).profile->correlation;
}

Shares judge(const asperity::Recording& recording) {
  const asperity::ProcessResult result = asperity::process_recording(recording, {});
  if (!result.accuracy || !result.accuracy->profile) throw asperity::Error("no profile");
  const asperity::TipMotion& motion = result.trajectory.motion;
  const asperity::Truth& truth = *recording.truth;
  const std::size_t n = motion.size();
  const auto seconds = [&](std::int64_t t_ns) {
    return static_cast<double>(t_ns - motion.t_ns[0]) * asperity::kNanosecond_s;
  };
  // The axes: the base's normal under the tip. True positions at the motion's times.
  std::vector<double> t_s(n), true_s, acceleration(n);
  for (std::size_t i = 0; i < n; ++i) t_s[i] = seconds(motion.t_ns[i]);
  for (const std::int64_t t_ns : truth.t_ns) true_s.push_back(seconds(t_ns));
  std::array<std::vector<double>, 3> true_m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> x;
    for (const Eigen::Vector3d& p : truth.p_world_tip_m) x.push_back(p[static_cast<Eigen::Index>(axis)]);
    true_m[axis] = asperity::interpolate(true_s, x, t_s, 1e9);
  }
  std::vector<double> height_m(n);
  std::size_t first = n, last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d p(true_m[0][i], true_m[1][i], true_m[2][i]);
    height_m[i] = result.base.path.n_world[i].dot(p - result.base.path.p_world_m[i]);
    acceleration[i] = result.base.path.n_world[i].dot(motion.a_world_tip_mps2[i]);
    if (result.base.contact[i] == 0 || !(result.base.speed_mps[i] > 3e-3)) continue;
    first = std::min(first, i);
    last = i;
  }
  if (last < first + 200) throw asperity::Error("no motion in contact");
  std::vector<double> pose_s, pose_m;
  std::size_t k = 0;
  for (std::size_t j = 0; j < recording.tracker.size(); ++j) {
    const double at_s = seconds(recording.tracker.t_ns[j]) - recording.calibration.tracker.latency_s;
    if (at_s < t_s.front() || at_s > t_s.back()) continue;
    while (k + 1 < n && t_s[k + 1] <= at_s) ++k;
    const asperity::Pose& pose = recording.tracker.T_world_marker[j];
    const double h_m = result.base.path.n_world[k].dot(
        pose.translation_m + pose.rotation * recording.calibration.tip_in_marker_m - result.base.path.p_world_m[k]);
    if (std::abs(h_m - height_m[k]) > 3e-3) continue;  // flipped or gone astray
    pose_s.push_back(at_s);
    pose_m.push_back(h_m);
  }
  const double rate_Hz = static_cast<double>(n - 1) / t_s.back();
  const Grid grid(t_s[first], t_s[last], rate_Hz);
  const std::size_t lines = grid.size();
  const Spectrum h = grid.transform(t_s, height_m);
  std::vector<double> square(lines);
  for (std::size_t i = 0; i < lines; ++i) square[i] = std::pow(2.0 * std::numbers::pi * grid.frequency_Hz(i), 2);
  std::vector<Channel> channels(3);
  channels[0] = {grid.transform(pose_s, pose_m), std::vector<double>(lines, 1.0)};
  channels[1] = {grid.transform(t_s, acceleration), {}};
  for (std::size_t i = 0; i < lines; ++i) channels[1].gain.push_back(-square[i]);
  channels[2] = {grid.transform(t_s, motion.force_N), std::vector<double>(lines, 0.0)};
  // The impedance's even part, from 2 to 80 Hz.
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t i = 1; i < lines; ++i) {
    if (grid.frequency_Hz(i) < 2.0 || grid.frequency_Hz(i) > 80.0) continue;
    const Eigen::Vector2d row(1.0, -square[i]);
    const double weight = 1.0 / (1.0 + square[i] * square[i] * 1e-9);
    normal += weight * std::norm(h[i]) * row * row.transpose();
    right += weight * (std::conj(h[i]) * channels[2].measured[i]).real() * row;
  }
  const Eigen::Vector2d impedance = normal.ldlt().solve(right);
  for (std::size_t i = 0; i < lines; ++i) channels[2].gain[i] = impedance[0] - impedance[1] * square[i];

  const std::vector<double> surface = density(h, lines);
  std::vector<std::vector<double>> error;
  for (const Channel& c : channels) {
    Spectrum e(lines);
    for (std::size_t i = 0; i < lines; ++i) e[i] = c.measured[i] - c.gain[i] * h[i];
    error.push_back(density(e, lines));
  }
  const std::vector<double>& tip_s_m = result.base.tip_s_m;
  const double on_surface =
      tip_s_m.empty() ? 1.0 : result.base.length_m / *std::max_element(tip_s_m.begin(), tip_s_m.end());
  // The correlation of these heights at the true positions.
  const auto judge_heights = [&](const std::vector<double>& estimate_m) {
    asperity::TipMotion oracle = motion;
    for (std::size_t i = 0; i < n; ++i) {
      const double off_m = std::isfinite(estimate_m[i]) ? estimate_m[i] - height_m[i] : 0.0;
      oracle.p_world_tip_m[i] =
          Eigen::Vector3d(true_m[0][i], true_m[1][i], true_m[2][i]) + off_m * result.base.path.n_world[i];
    }
    return correlation(recording, oracle, on_surface);
  };
  std::vector<double> own_m(n);
  for (std::size_t i = 0; i < n; ++i)
    own_m[i] = result.base.path.n_world[i].dot(motion.p_world_tip_m[i] - result.base.path.p_world_m[i]);
  // The same at the product's own positions.
  const auto judge_at_own = [&](const std::vector<double>& estimate_m) {
    asperity::TipMotion oracle = motion;
    for (std::size_t i = 0; i < n; ++i) {
      if (std::isfinite(estimate_m[i]))
        oracle.p_world_tip_m[i] += (estimate_m[i] - own_m[i]) * result.base.path.n_world[i];
    }
    return correlation(recording, oracle, on_surface);
  };
  const auto with_channels = [&](std::size_t count, bool knows_surface) {
    Spectrum best(2 * lines, 0.0);
    for (std::size_t i = 0; i < lines; ++i) {
      double information = knows_surface ? 1.0 / std::max(surface[i], 1e-300) : 0.0;
      Complex sum = 0.0;
      for (std::size_t c = 0; c < count; ++c) {
        sum += channels[c].gain[i] * channels[c].measured[i] / error[c][i];
        information += channels[c].gain[i] * channels[c].gain[i] / error[c][i];
      }
      best[i] = sum / information;
      if (i > 0) best[2 * lines - i] = std::conj(best[i]);
    }
    return grid.back(best, t_s);
  };
  const std::vector<double> knows_surface = with_channels(2, true);
  return {result.accuracy->profile->correlation,
          judge_heights(own_m),
          judge_heights(with_channels(2, false)),
          judge_heights(knows_surface),
          judge_at_own(knows_surface),
          judge_heights(with_channels(3, true)),
          std::abs(result.accuracy->profile->length_error_percent)};
}

}  // namespace

int main(int argc, char** argv) {
  try {
    int scans = 4;
    std::uint64_t seed = 1;
    bool ours = true;
    double speed_mps = 0.025;
    bench::CaseChoice choice{{}, {"what"}, true};
    bench::read_options(
        argc, argv,
        {{"--scans", [&](auto value) { scans = static_cast<int>(bench::number_within(value, 1.0, 1e6)); }},
         {"--seed", [&](auto value) { seed = static_cast<std::uint64_t>(bench::number_within(value, 0.0, 1e12)); }},
         {"--simulator", [&](auto value) { ours = bench::is_first(value, "ours", "second"); }},
         {"--probes", [&](auto value) { choice.probes = bench::split_list(value); }},
         {"--speed", [&](auto value) { speed_mps = bench::number_within(value, 1e-3, 1.0); }},
         {"--families", [&](auto value) { choice.families = bench::split_list(value); }}});
    if (choice.families.empty()) {
      choice.families = ours ? std::vector<std::string>{"sine", "protoboard", "cable_tie", "sandpaper", "clay_pot"}
                             : std::vector<std::string>{"sine", "sines", "field", "ridges", "holes"};
    }
    std::printf(
        "| surface | probe | scans | product r | its heights, true positions | oracle: A and R | A, R and S | share, "
        "median | lowest | A, R and S, product's positions | share, median | A, R, S and force | length error, %% |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& probe : choice.probes) {
      for (const std::string& family : choice.families) {
        std::vector<double> product, own, two, oracle, share, at_own, own_share, force, length;
        for (int i = 0; i < scans; ++i) {
          asperity::Recording recording;
          if (ours) {
            asperity::SimulationConfig config = asperity::make_simulation_config(family, probe);
            config.seed = static_cast<std::int64_t>(seed) + i;
            config.hand.speed_mps = speed_mps;
            config.calibration.imperfection = 0.0;
            recording = asperity::simulate_recording(config);
          } else {
            recording =
                bench::simulate_second_case(seed * 1'000'000 + static_cast<std::uint64_t>(i), {{family}, {probe}, true})
                    .recording;
          }
          try {
            const Shares s = judge(recording);
            product.push_back(s.product);
            own.push_back(s.own_heights);
            two.push_back(s.two_noises);
            oracle.push_back(s.without_force);
            share.push_back(s.product / s.without_force);
            at_own.push_back(s.without_force_at_own);
            own_share.push_back(s.product / s.without_force_at_own);
            force.push_back(s.with_force);
            length.push_back(s.length_error_percent);
          } catch (const asperity::Error&) {
          }
        }
        if (product.empty()) continue;
        std::printf("| %s | %s | %zu | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.2f |\n",
                    family.c_str(), probe.c_str(), product.size(), asperity::median(product), asperity::median(own),
                    asperity::median(two), asperity::median(oracle), asperity::median(share),
                    *std::min_element(share.begin(), share.end()), asperity::median(at_own),
                    asperity::median(own_share), asperity::median(force), asperity::median(length));
        std::fflush(stdout);
      }
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "oracle: %s\n", error.what());
    return 1;
  }
}
