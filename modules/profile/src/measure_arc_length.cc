#include "asperity/profile/measure_arc_length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/signal/statistics.h"
#include "asperity/signal/zero_phase.h"
#include "closer_direction.h"
#include "even_path.h"

namespace asperity {

namespace {

constexpr double kPathRate_hz = 200.0;   // ample for directions that change at a few Hz
constexpr double kSpeedCutoff_hz = 3.0;  // for the speed that sets the direction's own cut-off

constexpr double kLowestCutoff_hz = 0.2;
constexpr double kLengthened = 2e-4;                         // of the length: what noise in the direction may add
constexpr double kLastingMotion_s = 0.25;                    // shorter is noise that looks like motion
constexpr double kLongestEnd_s = 0.5, kShortestEnd_s = 0.1;  // over which a rest's outer end is averaged
constexpr double kCreep_mps = 0.5e-3;  // about as fast as tips slide down the edge of a hole on both benches
// Standard deviations: creep below the first is noise (at the ends of a recording it is up to twice the usual), from
// the second on it is none; in between in proportion, so that the length has no step.
constexpr double kPerhapsCrept = 2.0, kCrept = 4.0;
constexpr double kClearMotion = 4.0;     // times what noise and tremor seem to move the tip: a direction within 15°
constexpr double kMostRest = 0.5;        // of the usual speed is motion, however noisy
constexpr double kBeyondNoise = 5.0;     // standard deviations: further no noise carries the tip
constexpr double kSameWay = 0.5;         // cosine: two directions within 60° are no reversal
constexpr double kUsualBend_m = 0.7e-3;  // where nothing is known of the noise
constexpr double kCloser = 4.0;          // times the bends' cut-off: of the direction in bends
constexpr double kHighestCutoff = 0.38;  // of the even path's rate: above, low_pass() leaves the path as it is
constexpr double kMostTurned_rad = 0.3;  // by noise, if it were white: no closer

std::vector<double> speeds(const EvenPath<2>& path) {
  std::vector<double> out(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) out[i] = velocity_mps(path, i).norm();
  return out;
}

// How fast the quick path seems to go across the slow one: noise and tremor, usual while the tip travels (by the
// median, so that bends do not count).
double wandering_mps(const EvenPath<2>& slow, const EvenPath<2>& quick, const std::vector<double>& speed,
                     double usual_mps, std::size_t first, std::size_t last) {
  std::vector<double> aside_mps;
  for (std::size_t i = first; i <= last; ++i) {
    const Eigen::Vector2d v = velocity_mps(slow, i);
    if (!(speed[i] > 0.5 * usual_mps) || !(v.norm() > 0.0)) continue;
    const Eigen::Vector2d along = v.normalized();
    const Eigen::Vector2d w = velocity_mps(quick, i);
    aside_mps.push_back(std::abs(along.x() * w.y() - along.y() * w.x()));
  }
  return aside_mps.empty() ? 0.0 : kSigmaPerMad * median(aside_mps);
}

// Of cells that seem to move, keeps the runs in which the tip gets further than `reach_m` from where it was: noise goes
// to and fro. Not by where a run ends: two rows of a raster end where they began. All, if none does.
void leave_out_noise(const EvenPath<2>& quick, double reach_m, std::vector<char>& moving) {
  std::vector<char> kept(moving.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < moving.size();) {
    std::size_t end = i;
    double furthest_m = 0.0;
    for (; end < moving.size() && moving[end] != 0; ++end)
      furthest_m = std::max(furthest_m, (quick.p_m[end] - quick.p_m[i]).norm());
    if (furthest_m > reach_m) {
      std::fill(kept.begin() + static_cast<std::ptrdiff_t>(i), kept.begin() + static_cast<std::ptrdiff_t>(end),
                char{1});
      any = true;
    }
    i = end + 1;
  }
  if (any) moving = std::move(kept);
}

struct Directions {
  std::vector<Eigen::Vector2d> tangent;  // unit, one a cell of the even path
  std::vector<std::size_t> turns;        // cells from which a reversed direction holds
};

// How far the slow path is from the quick one. Where the tip stops and starts the low-pass moves the path along itself:
// that is no bend, unless the path turns round.
double cut_m(const EvenPath<2>& slow, const EvenPath<2>& quick, std::size_t cell, bool beside_stop) {
  Eigen::Vector2d out_m = slow.p_m[cell] - quick.p_m[cell];
  const Eigen::Vector2d gentle = velocity_mps(slow, cell);
  if (!beside_stop || !(gentle.norm() > 0.0)) return out_m.norm();
  const Eigen::Vector2d along = gentle.normalized();
  if (along.dot(velocity_mps(quick, cell).normalized()) > kSameWay) out_m -= along.dot(out_m) * along;
  return out_m.norm();
}

// The direction of travel in a moving cell: that of the slow path, which noise hardly turns; where that
// cuts a bend by more than noise could, that of the quick one.
Eigen::Vector2d direction(const EvenPath<2>& slow, const EvenPath<2>& quick, std::size_t cell, double bend_m,
                          bool beside_stop) {
  Eigen::Vector2d tight = velocity_mps(quick, cell).normalized();
  const Eigen::Vector2d gentle = velocity_mps(slow, cell);
  if (!(gentle.norm() > 0.0)) return tight;
  const Eigen::Vector2d along = gentle.normalized();
  const double share = std::clamp(cut_m(slow, quick, cell, beside_stop) / bend_m - 1.0, 0.0, 1.0);
  const Eigen::Vector2d mixed = (1.0 - share) * along + share * tight;
  return mixed.norm() > 0.0 ? Eigen::Vector2d(mixed.normalized()) : tight;
}

// Marks the cells that are within a period of the slow low-pass of a stop of kLastingMotion_s or more.
std::vector<char> beside_stops(const std::vector<char>& moving, double slow_Hz, double step_s) {
  const auto reach = static_cast<std::size_t>(1.0 / (slow_Hz * step_s));
  const auto lasting = static_cast<std::size_t>(kLastingMotion_s / step_s);
  std::vector<char> out(moving.size(), 0);
  for (std::size_t i = 0; i < moving.size();) {
    std::size_t end = i;
    while (end < moving.size() && moving[end] == 0) ++end;
    if (end >= i + lasting) {
      const std::size_t first = i > reach ? i - reach : 0, last = std::min(moving.size(), end + reach);
      std::fill(out.begin() + static_cast<std::ptrdiff_t>(first), out.begin() + static_cast<std::ptrdiff_t>(last),
                char{1});
    }
    i = end + 1;
  }
  return out;
}

// Moving cells have the direction of their velocity. A rest between two of them keeps the first
// direction up to the point that lies outermost between the two, and has the second from there.
Directions find_directions(const EvenPath<2>& path, const EvenPath<2>& slow, const EvenPath<2>& quick,
                           const std::vector<char>& moving, const std::vector<char>& beside_stop, double bend_m) {
  const std::size_t n = path.size();
  Directions out;
  out.tangent.assign(n, Eigen::Vector2d::UnitX());
  std::size_t last = n;
  for (std::size_t i = 0; i < n; ++i) {
    if (moving[i] == 0) continue;
    out.tangent[i] = direction(slow, quick, i, bend_m, beside_stop[i] != 0);
    if (last == n) {
      std::fill(out.tangent.begin(), out.tangent.begin() + static_cast<std::ptrdiff_t>(i), out.tangent[i]);
    } else if (i > last + 1) {
      const Eigen::Vector2d outwards = out.tangent[last] - out.tangent[i];
      std::size_t cut = (last + i) / 2;
      if (outwards.norm() > 0.1) {
        double furthest = -std::numeric_limits<double>::infinity();
        for (std::size_t j = last; j <= i; ++j) {
          const double reach = outwards.dot(path.p_m[j]);
          if (reach > furthest) {
            furthest = reach;
            cut = j;
          }
        }
      }
      for (std::size_t j = last + 1; j < i; ++j) out.tangent[j] = j < cut ? out.tangent[last] : out.tangent[i];
      if (out.tangent[last].dot(out.tangent[i]) < 0.0) out.turns.push_back(cut);
    } else if (out.tangent[last].dot(out.tangent[i]) < 0.0) {
      out.turns.push_back(i);
    }
    last = i;
  }
  if (last != n)
    std::fill(out.tangent.begin() + static_cast<std::ptrdiff_t>(last), out.tangent.end(), out.tangent[last]);
  return out;
}

// The first of `moving`'s cells from which it moves for `cells` on end; its size if there is none.
template <class Iterator>
std::size_t first_lasting(Iterator begin, Iterator end, std::size_t cells) {
  std::size_t run = 0, at = 0;
  for (Iterator i = begin; i != end; ++i, ++at) {
    run = *i != 0 ? run + 1 : 0;
    if (run == cells) return at + 1 - cells;
  }
  return at;
}

// The place of a rest, s_m in time's order from its outer end: the median, so that it has not the noise of one end.
// Where the tip has crept by more than noise, as down a slope, it is where the rest's outer end was.
double rest_level_m(std::vector<double> s_m, std::size_t outer, double noise_m) {
  const std::size_t third = std::max<std::size_t>(1, s_m.size() / 3);
  const std::span<const double> all(s_m);
  const double whole_m = median(all);
  if (!(noise_m > 0.0)) return whole_m;
  const double crept_m = std::abs(median(all.first(third)) - median(all.last(third)));
  const double share = std::clamp((crept_m / noise_m - kPerhapsCrept) / (kCrept - kPerhapsCrept), 0.0, 1.0);
  return (1.0 - share) * whole_m + share * median(all.first(std::clamp<std::size_t>(outer, 1, s_m.size())));
}

// In the rest [begin, start) before a path s has its level, up to the last sample at which it still was there. From
// there on it is as measured, so that s has no step where the tip begins to creep.
void hold_before(std::vector<double>& s_m, std::size_t begin, std::size_t start, std::size_t stop, double level_m) {
  if (start <= begin) return;
  std::size_t leaves = start;
  while (leaves < stop && s_m[leaves] <= level_m) ++leaves;
  while (leaves > begin && s_m[leaves - 1] > level_m) --leaves;
  std::fill(s_m.begin() + static_cast<std::ptrdiff_t>(begin), s_m.begin() + static_cast<std::ptrdiff_t>(leaves),
            level_m);
}

// The same of the rest [stop, end) after it.
void hold_after(std::vector<double>& s_m, std::size_t start, std::size_t stop, std::size_t end, double level_m) {
  if (end <= stop) return;
  std::size_t arrives = stop;
  while (arrives > start && s_m[arrives - 1] >= level_m) --arrives;
  while (arrives < end && s_m[arrives] < level_m) ++arrives;
  std::fill(s_m.begin() + static_cast<std::ptrdiff_t>(arrives), s_m.begin() + static_cast<std::ptrdiff_t>(end),
            level_m);
}

}  // namespace

ArcLength measure_arc_length(std::span<const double> t_s, std::span<const Eigen::Vector2d> u_m,
                             std::span<const char> usable, const ArcLengthConfig& config) {
  const std::size_t n = t_s.size();
  if (u_m.size() != n || (!usable.empty() && usable.size() != n)) {
    throw Error("measure_arc_length: " + std::to_string(n) + " times, " + std::to_string(u_m.size()) + " points, " +
                std::to_string(usable.size()) + " marks");
  }
  for (std::size_t i = 1; i < n; ++i) {
    if (!(t_s[i] > t_s[i - 1])) throw Error("measure_arc_length: time does not rise at sample " + std::to_string(i));
  }
  ArcLength out;
  out.s_m.assign(n, 0.0);
  out.speed_mps.assign(n, 0.0);
  std::size_t begin = 0, end = n;
  if (!usable.empty()) {
    while (begin < n && usable[begin] == 0) ++begin;
    while (end > begin && usable[end - 1] == 0) --end;
  }
  if (end < begin + 3) return out;

  const auto path = space_evenly<2>(t_s, u_m, kPathRate_hz);
  const std::size_t first_cell = index_at(path, t_s[begin]), last_cell = index_at(path, t_s[end - 1]);
  const std::vector<double> rough_mps = speeds(low_pass(path, kSpeedCutoff_hz));
  const std::span<const double> travelled(rough_mps.data() + first_cell, last_cell - first_cell + 1);
  const double usual_mps = percentile(travelled, 80.0);
  const auto cutoff_Hz = [&](double cycles_per_mm) {
    return std::max(kLowestCutoff_hz, cycles_per_mm * 1e3 * usual_mps);
  };
  // Below a cut-off f, noise of σ that reaches beyond it turns the direction by 2πfσ/√3, and lengthens by half the
  // square.
  constexpr double kNoiseTurns = 2.0 * std::numbers::pi / std::numbers::sqrt3;
  const double quiet_cycles_per_mm = config.noise_m > 0.0
                                         ? std::sqrt(2.0 * kLengthened) / (kNoiseTurns * 1e3 * config.noise_m)
                                         : config.direction_cutoff_cycles_per_mm;
  const double slow_Hz = cutoff_Hz(std::min(config.direction_cutoff_cycles_per_mm, quiet_cycles_per_mm));
  const auto slow = low_pass(path, slow_Hz);
  const double quick_Hz = cutoff_Hz(std::max(config.bend_cutoff_cycles_per_mm, config.direction_cutoff_cycles_per_mm));
  const auto quick = low_pass(path, quick_Hz);
  const std::vector<double> speed = speeds(quick);
  const double wander_mps = wandering_mps(slow, quick, speed, usual_mps, first_cell, last_cell);
  const double rest_mps = std::max(std::max(config.rest_speed_mps, config.rest_fraction * usual_mps),
                                   std::min(kClearMotion * wander_mps, kMostRest * usual_mps));
  std::vector<char> moving(path.size(), 0);
  for (std::size_t i = first_cell; i <= last_cell; ++i) moving[i] = speed[i] > rest_mps ? 1 : 0;
  leave_out_noise(quick, kBeyondNoise * config.noise_m, moving);
  const double bend_m = config.bend_m > 0.0 ? config.bend_m : kUsualBend_m;
  // Where bends below the noise are followed, as over a mesh, every distance counts.
  const std::vector<char> beside =
      bend_m > 2.0 * config.noise_m ? beside_stops(moving, slow_Hz, path.step_s) : std::vector<char>(moving.size(), 0);
  const Directions directions = find_directions(path, slow, quick, moving, beside, bend_m);
  const auto reach = static_cast<std::size_t>(0.5 / (slow_Hz * path.step_s));
  std::vector<char> cut(path.size(), 0);
  for (std::size_t i = 0; i < path.size() && bend_m > 2.0 * config.noise_m; ++i)
    cut[i] = moving[i] != 0 && cut_m(slow, quick, i, beside[i] != 0) > bend_m ? 1 : 0;
  // Where noise lets it be followed no closer than the quick path does, what the bends hide is an error alone.
  const double closer_Hz = std::min(kCloser * quick_Hz, kHighestCutoff / path.step_s);
  const double quiet_Hz = config.noise_m > 0.0 ? kMostTurned_rad * usual_mps / (kNoiseTurns * config.noise_m) : 0.0;
  const bool follows = quiet_Hz > quick_Hz;
  const auto sharp = low_pass(path, follows ? std::min(closer_Hz, quiet_Hz) : closer_Hz);
  std::vector<PathPart> parts = find_bends(slow, quick, moving, cut, reach);
  // Not where bends below the noise are followed anyway, as over a mesh: there a reversal is one of them.
  if (bend_m > 2.0 * config.noise_m)
    mark_reversals(quick, sharp, moving, rest_mps, static_cast<std::size_t>(0.5 / (quick_Hz * path.step_s)), parts);
  const CloserDirection closer(sharp, directions.tangent, moving, std::move(parts), rest_mps);
  out.bends_m = closer.added_m();

  for (std::size_t i = 0; i < n; ++i) out.speed_mps[i] = speed[index_at(path, t_s[i])];
  for (std::size_t i = begin + 1; i < end; ++i) {
    const std::size_t cell = index_at(path, 0.5 * (t_s[i - 1] + t_s[i]));
    const Eigen::Vector2d step_m = u_m[i] - u_m[i - 1];
    out.s_m[i] = out.s_m[i - 1] + directions.tangent[cell].dot(step_m) + (follows ? closer.added_m(cell, step_m) : 0.0);
  }
  // The path lies between the places of the rests before and after it: the lowest of many noisy s would be too low, and
  // the length too long.
  const auto lasting = static_cast<std::size_t>(kLastingMotion_s * kPathRate_hz);
  const std::size_t starts = first_lasting(moving.begin(), moving.end(), lasting);
  const std::size_t stops = path.size() - first_lasting(moving.rbegin(), moving.rend(), lasting);
  if (starts < stops) {
    std::size_t start = begin, stop = end;
    while (start < end && index_at(path, t_s[start]) < starts) ++start;
    while (stop > start && index_at(path, t_s[stop - 1]) >= stops) --stop;
    // As long as it takes a tip that creeps to go by one standard deviation.
    const double end_s = std::clamp(config.noise_m / kCreep_mps, kShortestEnd_s, kLongestEnd_s);
    const auto outer = static_cast<std::size_t>(end_s * static_cast<double>(end - begin) / (t_s[end - 1] - t_s[begin]));
    const auto s_at = [&](std::size_t i) { return out.s_m.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::vector<double> before(s_at(begin), s_at(start));
    const std::vector<double> after(std::make_reverse_iterator(s_at(end)), std::make_reverse_iterator(s_at(stop)));
    if (!before.empty()) hold_before(out.s_m, begin, start, stop, rest_level_m(before, outer, config.noise_m));
    if (!after.empty()) hold_after(out.s_m, start, stop, end, rest_level_m(after, outer, config.noise_m));
    const double first_m = out.s_m[begin];
    const double last_m = out.s_m[end - 1] - first_m;
    for (std::size_t i = begin; i < end; ++i) {
      out.s_m[i] -= first_m;
      if (start > begin) out.s_m[i] = std::max(out.s_m[i], 0.0);
      if (stop < end) out.s_m[i] = std::min(out.s_m[i], last_m);
    }
  }
  const double rate_hz = static_cast<double>(end - 1 - begin) / (t_s[end - 1] - t_s[begin]);
  if (config.along_cutoff_Hz > 0.0 && config.along_cutoff_Hz * 1.3 < 0.5 * rate_hz) {
    const std::span<const double> inside(out.s_m.data() + begin, end - begin);
    const std::vector<double> smoothed = zero_phase_lowpass(inside, config.along_cutoff_Hz, rate_hz);
    std::copy(smoothed.begin(), smoothed.end(), out.s_m.begin() + static_cast<std::ptrdiff_t>(begin));
  }
  std::fill(out.s_m.begin() + static_cast<std::ptrdiff_t>(end), out.s_m.end(), out.s_m[end - 1]);

  for (const std::size_t cell : directions.turns) {
    const auto at = std::lower_bound(t_s.begin(), t_s.end(), path.time_s(cell));
    out.turning_points.push_back(std::min(static_cast<std::size_t>(at - t_s.begin()), n - 1));
  }
  return out;
}

}  // namespace asperity
