#include "path_evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kEvidenceRate_hz = 200.0;
constexpr double kWindow_m = 10e-3;  // four periods of a 2.5 mm texture
constexpr double kEvidenceSpeedCutoff_hz = 3.0;
constexpr double kFineCutoff_hz = 15.0;     // above the hand's tremor
constexpr double kSlowBandwidth_hz = 1.0;   // of the tracker's error after smoothing
constexpr double kLifted_m = 1e-3;          // from where the tip left to where it touched again: another pass
constexpr double kLargestSpeed_mps = 20.0;  // mean in contact; no hand is as fast, and the work grows with the distance

// The number of each cell's pass.
std::vector<std::size_t> number_passes(const PathEvidence& evidence, const std::vector<char>& touching) {
  std::vector<std::size_t> out(touching.size(), 0);
  std::size_t pass = 0, last = touching.size();
  bool lifted = false;
  for (std::size_t c = 0; c < touching.size(); ++c) {
    if (touching[c] == 0) {
      lifted = true;
    } else {
      if (lifted && last < touching.size() && (evidence.path.p_m[c] - evidence.path.p_m[last]).norm() > kLifted_m) {
        ++pass;
      }
      lifted = false;
      last = c;
    }
    out[c] = pass;
  }
  return out;
}

}  // namespace

double PathEvidence::weight_in(const CoarseWindow& window, std::size_t cell) const {
  const double x = (travelled_m[cell] + 0.5 * weight[cell] - window.centre_m) / window.width_m;
  return std::abs(x) > 0.5 ? 0.0 : weight[cell] * (1.0 + std::cos(2.0 * std::numbers::pi * x));
}

PathEvidence gather_evidence(const TipMotion& motion, std::span<const double> t_s, std::span<const char> contact,
                             const Eigen::Vector3d& tip_in_marker_m, const BasePathConfig& config) {
  PathEvidence out;
  out.path = space_evenly<3>(t_s, std::span<const Eigen::Vector3d>(motion.p_world_tip_m), kEvidenceRate_hz);
  const std::size_t cells = out.path.size();
  const EvenPath<3> smooth = low_pass(out.path, kEvidenceSpeedCutoff_hz);
  const EvenPath<3> slow = low_pass(out.path, kFineCutoff_hz);

  out.force_measured =
      std::any_of(motion.force_N.begin(), motion.force_N.end(), [](double f) { return std::isfinite(f); });
  std::vector<char> touching(cells, 0);
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    if (contact[i] != 0) touching[index_at(out.path, t_s[i])] = 1;
  }
  // Cells between sparse samples take their neighbour's mark.
  if (t_s.size() < 2 * cells) {
    for (std::size_t c = 0; c < cells; ++c) {
      const auto at = std::lower_bound(t_s.begin(), t_s.end(), out.path.time_s(c));
      touching[c] = contact[std::min(static_cast<std::size_t>(at - t_s.begin()), t_s.size() - 1)];
    }
  }
  std::vector<double> speed(cells);
  std::vector<double> inside;
  for (std::size_t c = 0; c < cells; ++c) {
    speed[c] = velocity_mps(smooth, c).norm();
    if (touching[c] != 0) inside.push_back(speed[c]);
  }
  if (inside.size() < 3) throw Error("base path: the tip is in contact for fewer than 3 cells of 5 ms");
  const double rest_mps =
      std::max(config.arc_length.rest_speed_mps, config.arc_length.rest_fraction * percentile(inside, 80.0));

  out.weight.assign(cells, 0.0);
  out.travelled_m.assign(cells + 1, 0.0);
  out.probe_axis.assign(cells, Eigen::Vector3d::Zero());
  for (std::size_t c = 0; c < cells; ++c) {
    if (touching[c] != 0 && speed[c] > rest_mps) {
      out.weight[c] = speed[c] * out.path.step_s;
      out.moving_s += out.path.step_s;
    }
    out.travelled_m[c + 1] = out.travelled_m[c] + out.weight[c];
  }
  if (tip_in_marker_m.norm() > 0.0) {
    const Eigen::Vector3d axis_in_marker = -tip_in_marker_m.normalized();
    for (std::size_t c = 0; c < cells; ++c) {
      const auto at = std::lower_bound(t_s.begin(), t_s.end(), out.path.time_s(c));
      const std::size_t i = std::min(static_cast<std::size_t>(at - t_s.begin()), t_s.size() - 1);
      out.probe_axis[c] = motion.q_world_marker[i] * axis_in_marker;
    }
  }

  const double total_m = out.travelled_m.back();
  if (!(total_m > 0.0)) throw Error("base path: the tip does not travel while in contact");
  if (!(total_m < kLargestSpeed_mps * out.moving_s)) {
    throw Error(
        fmt::format("base path: the tip would travel {:.3g} m in {:.3g} s, faster than a hand: check the "
                    "calibration's units and offsets",
                    total_m, out.moving_s));
  }
  const std::vector<std::size_t> pass = number_passes(out, touching);
  const double window_m = std::min(kWindow_m, total_m / 6.0);
  const auto count = static_cast<std::size_t>(std::max(5.0, std::floor(2.0 * total_m / window_m) - 1.0));
  for (std::size_t k = 0; k < count; ++k) {
    const double centre_m =
        0.5 * window_m + (total_m - window_m) * static_cast<double>(k) / static_cast<double>(count - 1);
    const auto cell_at = [&](double travelled_m) {
      const auto at = std::upper_bound(out.travelled_m.begin(), out.travelled_m.end(), travelled_m);
      return std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, at - out.travelled_m.begin() - 1)),
                      cells - 1);
    };
    const std::size_t middle = cell_at(centre_m);
    CoarseWindow window{cell_at(centre_m - 0.5 * window_m), cell_at(centre_m + 0.5 * window_m) + 1, centre_m, window_m};
    while (pass[window.begin] != pass[middle]) ++window.begin;
    while (pass[window.end - 1] != pass[middle]) --window.end;
    double sum = 0.0;
    Eigen::Vector3d point = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::Zero();
    Eigen::Matrix3d fine = Eigen::Matrix3d::Zero();
    for (std::size_t c = window.begin; c < window.end; ++c) {
      const double w = out.weight_in(window, c);
      if (w == 0.0) continue;
      const Eigen::Vector3d tangent = velocity_mps(smooth, c).normalized();
      Eigen::Vector3d across = out.path.p_m[c] - slow.p_m[c];
      across -= across.dot(tangent) * tangent;
      sum += w;
      point += w * out.path.p_m[c];
      axis += w * out.probe_axis[c];
      fine += w * across * across.transpose();
    }
    if (!(sum > 0.0)) continue;
    out.windows.push_back(window);
    out.coarse_m.emplace_back(point / sum);
    out.coarse_axis.emplace_back(axis / sum);
    out.coarse_fine_m2.emplace_back(fine / sum);
  }
  if (out.coarse_m.size() < 4) throw Error("base path: the path in contact is too short to fit a shape to");
  out.independent = std::clamp(2.0 * kSlowBandwidth_hz * out.moving_s, 2.0, static_cast<double>(out.coarse_m.size()));
  return out;
}

}  // namespace asperity
