#include "rubbing.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "asperity/base/nan.h"
#include "asperity/base/units.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kDirection_s = 0.05;  // to either side: the direction of travel is that of a hand, not of the relief
constexpr double kSteepest = 1.0;      // slopes beyond it are impacts, not facets
constexpr double kSlideAfter_s = 1.0;  // a stick ends in sliding within this time, and begins so

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

bool slides(const Rubbing& r, std::size_t i, const FrictionConfig& config) {
  return r.touching[i] != 0 && r.speed_mps[i] >= config.min_speed_mps && std::isfinite(r.angle_rad[i]);
}

}  // namespace

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

}  // namespace asperity
