#include "asperity/profile/make_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/units.h"
#include "asperity/profile/extract_texture.h"
#include "asperity/profile/resample_over_path.h"
#include "asperity/profile/surface_under_tip.h"
#include "asperity/signal/resample.h"

namespace asperity {

namespace {

constexpr double kStopWander_m = 0.3e-3;   // s moves by its slow error even when the tip rests
constexpr double kCreeping = 0.05;         // of the mean speed: slower at the end of a path is no stroke
constexpr double kLeastCreep_s = 0.05;     // shorter is the end of the motion itself
constexpr double kRestBeside_s = 0.02;     // of a rest before or after the path, what belongs to it
constexpr double kStopEdge_s = 0.25;       // of a long stop, what still belongs to the stroke beside it
constexpr std::ptrdiff_t kSpeedReach = 4;  // cells to either side over which the speed is taken

struct Samples {
  std::vector<double> t_s, height_m, sigma_m, force_N;
};

Samples take_samples(const TipMotion& motion, const BasePath& base, const ProfileConfig& config) {
  const std::size_t n = motion.size();
  Samples out;
  out.t_s.resize(n);
  out.height_m.resize(n);
  out.sigma_m.assign(n, kNan);
  // The tip's error in the marker is one error: heights are above their base, which takes what is the same everywhere.
  const Eigen::Vector3d tip_m2 = motion.sigma_tip_in_marker_m.cwiseAbs2();
  std::vector<Eigen::Vector3d> n_marker;
  Eigen::Vector3d mean_n_marker = Eigen::Vector3d::Zero();
  if (!tip_m2.isZero(0.0)) {
    n_marker.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      n_marker[i] = motion.q_world_marker[i].conjugate() * base.n_world[i];
      mean_n_marker += n_marker[i] / static_cast<double>(n);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    out.t_s[i] = static_cast<double>(motion.t_ns[i] - motion.t_ns[0]) * kNanosecond_s;
    out.height_m[i] = base.n_world[i].dot(motion.p_world_tip_m[i] - base.p_world_m[i]);
    if (!motion.cov_world_tip_m2.empty()) {
      double variance_m2 = base.n_world[i].dot(motion.cov_world_tip_m2[i] * base.n_world[i]);
      if (!n_marker.empty()) {
        variance_m2 += tip_m2.dot((n_marker[i] - mean_n_marker).cwiseAbs2() - n_marker[i].cwiseAbs2());
      }
      out.sigma_m[i] = std::sqrt(std::max(0.0, variance_m2));
    }
  }
  out.force_N.assign(n, kNan);
  std::vector<double> read_s, read_N;
  for (std::size_t i = 0; i < motion.force_N.size(); ++i) {
    if (!std::isfinite(motion.force_N[i])) continue;
    read_s.push_back(out.t_s[i]);
    read_N.push_back(motion.force_N[i]);
  }
  if (!read_s.empty()) out.force_N = interpolate(read_s, read_N, out.t_s, config.max_force_hole_s);
  return out;
}

// One number a sample: the part of the profile it belongs to, -1 for the middle of a long stop.
std::vector<int> find_parts(const std::vector<double>& t_s, const std::vector<double>& s_m, double max_stop_s) {
  const std::size_t n = t_s.size();
  std::vector<int> part(n, 0);
  int current = 0;
  std::size_t marked = 0;
  for (std::size_t i = 0; i < n;) {
    std::size_t end = i + 1;
    while (end < n && std::abs(s_m[end] - s_m[i]) < kStopWander_m) ++end;
    if (t_s[end - 1] - t_s[i] <= max_stop_s) {
      ++i;
      continue;
    }
    const double edge_s = std::min(kStopEdge_s, 0.25 * max_stop_s);
    for (; marked < end; ++marked) {
      const bool before = t_s[marked] <= t_s[i] + edge_s, after = t_s[marked] >= t_s[end - 1] - edge_s;
      part[marked] = before ? current : after ? current + 1 : -1;
    }
    ++current;
    i = end;
  }
  for (; marked < n; ++marked) part[marked] = current;
  return part;
}

// Moves the ends [moves, stands) of a motion inwards over what is crept there at less than kCreeping of its mean speed,
// in each kLeastCreep_s. As in a rest, slow errors of the height are steps there: 75 µm within 0.1 mm of smooth glass.
void leave_out_creep(const std::vector<double>& t_s, const std::vector<double>& s_m, std::size_t& moves,
                     std::size_t& stands) {
  const std::size_t first = moves, last = stands - 1;
  const double slow_mps = kCreeping * (s_m[last] - s_m[first]) / (t_s[last] - t_s[first]);
  const auto creeps = [&](std::size_t a, std::size_t b) { return s_m[b] - s_m[a] <= slow_mps * (t_s[b] - t_s[a]); };
  std::size_t begin = first, end = last;
  for (std::size_t ahead = first; ahead < last; ++ahead) {
    if (t_s[ahead] - t_s[begin] < kLeastCreep_s) continue;
    if (!creeps(begin, ahead)) break;
    ++begin;
  }
  for (std::size_t behind = last; behind > first; --behind) {
    if (t_s[end] - t_s[behind] < kLeastCreep_s) continue;
    if (!creeps(behind, end)) break;
    --end;
  }
  if (begin >= end) return;
  moves = begin;
  stands = end + 1;
}

// Of the rests before and after the path, in which s stands (measure_arc_length.h), only what is next to the motion
// stays: the height's slow error there is not that of the stroke, and would make a step at its end.
void leave_out_end_rests(const std::vector<double>& t_s, const std::vector<double>& s_m, std::vector<char>& use) {
  std::size_t first = 0, last = use.size();
  while (first < last && use[first] == 0) ++first;
  while (last > first && use[last - 1] == 0) --last;
  if (last <= first) return;
  std::size_t moves = first, stands = last;
  while (moves < last && s_m[moves] == s_m[first]) ++moves;
  while (stands > moves && s_m[stands - 1] == s_m[last - 1]) --stands;
  if (moves >= stands) return;
  leave_out_creep(t_s, s_m, moves, stands);
  for (std::size_t i = first; i < moves; ++i) use[i] = t_s[moves] - t_s[i] <= kRestBeside_s ? use[i] : char{0};
  for (std::size_t i = stands; i < last; ++i) use[i] = t_s[i] - t_s[stands - 1] <= kRestBeside_s ? use[i] : char{0};
}

void check_sizes(const TipMotion& motion, const BasePath& base, std::span<const char> usable) {
  const std::size_t n = motion.size();
  if (base.size() != n || base.n_world.size() != n || base.s_m.size() != n || motion.p_world_tip_m.size() != n ||
      (!usable.empty() && usable.size() != n) ||
      (!motion.cov_world_tip_m2.empty() && motion.cov_world_tip_m2.size() != n) ||
      (!motion.force_N.empty() && motion.force_N.size() != n)) {
    throw Error("profile: motion, base path and marks differ in size (" + std::to_string(n) + " samples)");
  }
}

}  // namespace

Profile make_profile(const TipMotion& motion, const BasePath& base, std::span<const char> usable,
                     const ProfileConfig& config) {
  check_sizes(motion, base, usable);
  const std::size_t n = motion.size();
  Samples samples = take_samples(motion, base, config);
  if (config.contact_resonance_Hz > 0.0) {
    const std::vector<double> above_m = surface_above_tip_m(motion, base, usable, config.contact_resonance_Hz);
    for (std::size_t i = 0; i < n; ++i) samples.height_m[i] += above_m[i];
  }
  std::vector<char> use(n, 1);
  if (!usable.empty()) std::copy(usable.begin(), usable.end(), use.begin());
  const std::vector<int> part = find_parts(samples.t_s, base.s_m, config.max_stop_s);
  const auto leave_out_stops = [&](std::vector<char>& marks) {
    for (std::size_t i = 0; i < n; ++i) marks[i] = part[i] < 0 ? char{0} : marks[i];
  };
  const auto span_of = [&](const std::vector<char>& marks) {
    double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
    for (std::size_t i = 0; i < n; ++i) {
      if (marks[i] == 0) continue;
      low_m = std::min(low_m, base.s_m[i]);
      high_m = std::max(high_m, base.s_m[i]);
    }
    return std::pair(low_m, high_m);
  };
  std::vector<char> path = use;
  leave_out_stops(path);
  const auto [from_m, to_m] = span_of(path);
  leave_out_end_rests(samples.t_s, base.s_m, use);
  leave_out_stops(use);
  const auto [low_m, high_m] = span_of(use);
  if (!(high_m > low_m)) throw Error("profile: no stretch of the motion is in contact and moving");

  Profile out;
  out.spacing_m = config.spacing_m;
  out.from_m = from_m;
  out.to_m = to_m;
  out.crept_first_m = low_m - from_m;
  out.crept_last_m = to_m - high_m;
  count_points(high_m - low_m, config.spacing_m);
  const auto first = static_cast<std::ptrdiff_t>(std::ceil(low_m / config.spacing_m - 1e-9));
  const auto last = static_cast<std::ptrdiff_t>(std::floor(high_m / config.spacing_m + 1e-9));
  if (last < first) throw Error("profile: the path in contact is shorter than the profile's spacing");
  const auto count = static_cast<std::size_t>(last - first + 1);
  out.s_m.resize(count);
  for (std::size_t k = 0; k < count; ++k)
    out.s_m[k] = config.spacing_m * static_cast<double>(first + static_cast<std::ptrdiff_t>(k));
  out.height_m.assign(count, kNan);

  const std::array<std::span<const double>, 4> channels{samples.height_m, samples.sigma_m, samples.force_N,
                                                        samples.t_s};
  std::vector<std::size_t> breaks;
  const int parts = *std::max_element(part.begin(), part.end()) + 1;
  std::size_t begin = 0;
  std::ptrdiff_t seam_before = -1;  // the end of the part before; -1 for none
  for (int p = 0; p < parts; ++p) {
    // Parts follow one another in time, so each is looked at once, and only where it has points.
    std::size_t end = begin;
    while (end < n && part[end] <= p) ++end;
    const std::array<std::span<const double>, 1> height{std::span(samples.height_m).subspan(begin, end - begin)};
    const PathKnots knots = gather_knots(std::span(base.s_m).subspan(begin, end - begin), height,
                                         std::span(use).subspan(begin, end - begin), 0.25 * config.spacing_m);
    begin = end;
    if (knots.s_m.empty()) continue;
    const auto cell = [&](double s_m) {
      return std::clamp<std::ptrdiff_t>(std::lround(s_m / config.spacing_m) - first, 0, last - first);
    };
    const std::ptrdiff_t from = cell(knots.s_m.front()), to = cell(knots.s_m.back());
    const std::vector<double> part_m = resample_smooth(knots, first + from, static_cast<std::size_t>(to - from + 1),
                                                       config.spacing_m, config.max_hole_m);
    for (std::ptrdiff_t k = from; k <= to; ++k) {
      double& height_m = out.height_m[static_cast<std::size_t>(k)];
      if (!std::isfinite(height_m)) height_m = part_m[static_cast<std::size_t>(k - from)];
    }
    // A rest after the path has a part of its own, without points: no seam.
    if (seam_before >= 0) breaks.push_back(static_cast<std::size_t>(seam_before));
    seam_before = to;
  }
  // After all parts, so that the next one does not fill the seam.
  for (const std::size_t seam : breaks) out.height_m[seam] = kNan;

  const PathKnots knots = gather_knots(base.s_m, channels, use, 0.25 * config.spacing_m);
  out.sigma_m = resample_linear(knots, 1, first, count, config.spacing_m, config.max_hole_m);
  out.force_N = resample_linear(knots, 2, first, count, config.spacing_m, config.max_hole_m);
  out.t_s = resample_linear(knots, 3, first, count, config.spacing_m, config.max_hole_m);
  out.speed_mps.assign(count, kNan);
  for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(count); ++k) {
    const auto a = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, k - kSpeedReach));
    const auto b = std::min(static_cast<std::size_t>(k + kSpeedReach), count - 1);
    const double took_s = out.t_s[b] - out.t_s[a];
    if (took_s > 0.0) out.speed_mps[static_cast<std::size_t>(k)] = (out.s_m[b] - out.s_m[a]) / took_s;
  }
  out.texture_m = extract_texture(out.height_m, config.spacing_m, config.cutoff_cycles_per_mm, config.bridge_m, breaks);
  return out;
}

}  // namespace asperity
