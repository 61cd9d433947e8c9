#include "smooth_batches.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>

namespace asperity {

namespace {

constexpr double kEven = 0.2;        // of the period: scatter of the steps within a batch, at most
constexpr double kTick = 0.02;       // of the period: steps that are all multiples of more are of a coarse clock
constexpr std::size_t kApart = 100;  // samples: further apart than a batch is long
constexpr double kTogether = 1.7;    // times as much do stamps so far apart scatter as neighbours; single ones as much
constexpr double kJump = 0.2;        // of the period: a step so far from a whole number of periods is between batches
constexpr double kSigmas = 4.0;      // and so many of the steps' own scatter
constexpr double kFewestJumps = 8;   // of batches
// And this share of the steps. Where stamps scatter within a batch too, only the longest waits stand out of them: one
// jump in 500 steps is enough if it is not lost samples that are between the stamps. Single stamps with a normal
// scatter jump in 6 of 100 000 steps.
constexpr double kJumps_share = 0.01, kFewestJumps_share = 0.002;
constexpr double kWaitShare = 0.05;  // of the period: smaller waits are no reason to look for batches
constexpr double kFollow = 0.05;     // of its error, by which the count of periods follows a stamp
constexpr double kClump = 0.3;       // of the mean step: a median step below it is of samples stamped together
constexpr double kLook_s = 0.4;      // to either side of a step, whether it was a loss
constexpr double kLost = 0.6;        // of a period: shift of the least wait
constexpr double kWaits = 5.0;       // mean waits over batches: the least of so many is not as far off by chance
constexpr double kLongStep = 1.4;    // of a period: a shorter step has lost nothing
constexpr double kBatch_ns = 3e7;  // longest that a loss is looked for behind the step before which the stamps are late
constexpr double kExact = 0.15;    // of a period: a step so near to a whole number of periods is one
constexpr double kNode_s = 0.1;    // between the points at which the line is fitted
constexpr double kNormalMad = 1.4826;

double median(std::vector<double> x) {
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  return *middle;
}

double scatter_about(std::span<const double> x, double centre) {
  std::vector<double> far(x.size());
  std::transform(x.begin(), x.end(), far.begin(), [&](double v) { return std::abs(v - centre); });
  return kNormalMad * median(std::move(far));
}

// The largest number of nanoseconds of which all steps are multiples.
double common_tick(const std::vector<double>& step_ns) {
  std::int64_t tick = 0;
  for (const double step : step_ns) tick = std::gcd(tick, static_cast<std::int64_t>(step));
  return static_cast<double>(tick);
}

// The scatter of the steps over kApart samples, `late_ns` the stamps less a period each.
double scatter_apart(std::span<const double> late_ns) {
  std::vector<double> far;
  for (std::size_t i = 0; i + kApart < late_ns.size(); ++i) far.push_back(late_ns[i + kApart] - late_ns[i]);
  if (far.empty()) return 0.0;
  return scatter_about(far, median(far));
}

std::vector<double> late_by_index(const std::vector<double>& t_ns, double period_ns) {
  std::vector<double> out;
  for (const double t : t_ns) out.push_back(t - period_ns * static_cast<double>(out.size()));
  return out;
}

// Likewise, lost samples counted as whole periods, from a phase that follows the stamps.
std::vector<double> late_by_count(const std::vector<double>& t_ns, double period_ns) {
  std::vector<double> out;
  double phase_ns = t_ns.front() - period_ns, count = -1.0;
  for (const double t : t_ns) {
    const double steps = std::max(1.0, std::round((t - phase_ns) / period_ns));
    count += steps;
    phase_ns += steps * period_ns;
    phase_ns += kFollow * (t - phase_ns);
    out.push_back(t - period_ns * count);
  }
  return out;
}

// The period by the least waits of stretches: they are far more alike than single ones. The median over neighbouring
// stretches leaves a loss as it is.
double refine_period(const std::vector<double>& t_ns, double period_ns) {
  std::vector<double> least_ns, at;
  double end_ns = 0.0;
  for (std::size_t i = 0; i < t_ns.size(); ++i) {
    const double late_ns = t_ns[i] - period_ns * static_cast<double>(i);
    if (least_ns.empty() || t_ns[i] >= end_ns) {
      least_ns.push_back(late_ns);
      at.push_back(static_cast<double>(i));
      end_ns = t_ns[i] + 1e9 * kLook_s;
    } else if (late_ns < least_ns.back()) {
      least_ns.back() = late_ns;
      at.back() = static_cast<double>(i);
    }
  }
  std::vector<double> slopes;
  const std::size_t apart = std::clamp<std::size_t>(least_ns.size() / 3, 1, 5);
  for (std::size_t w = 0; w + apart < least_ns.size(); ++w) {
    slopes.push_back((least_ns[w + apart] - least_ns[w]) / (at[w + apart] - at[w]));
  }
  return slopes.empty() ? period_ns : period_ns + median(std::move(slopes));
}

struct Batches {
  double period_ns = 0.0;
  std::vector<char> ends;  // 1: the sample is its batch's last
};

// Whether the stamps are of batches, and where these end; an empty period if not.
Batches find_batches(const std::vector<double>& t_ns, const std::vector<double>& step_ns) {
  Batches out;
  const double typical = median(step_ns);
  double sum = 0.0, count = 0.0;
  for (const double step : step_ns) {
    if (step > 5e7) continue;  // a pause
    sum += step;
    count += 1.0;
  }
  if (count < kFewestJumps) return out;
  const double mean = sum / count;
  const bool clumped = typical < kClump * mean;
  const double scatter = scatter_about(step_ns, typical);
  if (!clumped && (scatter > kEven * typical || common_tick(step_ns) > kTick * typical ||
                   scatter_apart(late_by_index(t_ns, typical)) < kTogether * scatter)) {
    return out;
  }

  out.ends.assign(t_ns.size(), 0);
  out.ends.back() = 1;
  double jumps = 0.0;
  for (std::size_t i = 0; i < step_ns.size(); ++i) {
    const double step = step_ns[i];
    const double periods = std::max(1.0, std::round(step / typical));
    const bool jump = clumped ? step > kClump * mean
                              : std::abs(step - periods * typical) > std::max(kJump * typical, kSigmas * scatter);
    if (!jump) continue;
    out.ends[i] = 1;
    jumps += 1.0;
  }
  const auto steps = static_cast<double>(step_ns.size());
  if (jumps < std::max(kFewestJumps, kFewestJumps_share * steps)) return out;
  // Lost samples let stamps scatter over many samples as waits do, but by whole periods. With these counted, single
  // stamps are as far from each other as neighbours are, or by next to nothing if a decoder has made them even.
  if (!clumped && jumps < kJumps_share * steps &&
      scatter_apart(late_by_count(t_ns, typical)) < std::max(kTogether * scatter, kWaitShare * typical))
    return out;
  // The median over long stretches, which a loss here and there leaves as it is; within a batch the host may count back
  // by a nominal period.
  std::vector<std::size_t> last;
  for (std::size_t i = 0; i < out.ends.size(); ++i) {
    if (out.ends[i] != 0) last.push_back(i);
  }
  const std::size_t apart = std::clamp<std::size_t>(last.size() / 4, 1, 200);
  std::vector<double> periods;
  for (std::size_t b = 0; b + apart < last.size(); ++b) {
    periods.push_back((t_ns[last[b + apart]] - t_ns[last[b]]) / static_cast<double>(last[b + apart] - last[b]));
  }
  if (!periods.empty()) out.period_ns = refine_period(t_ns, median(std::move(periods)));
  return out;
}

// The least and the mean wait in a stretch, and how many batches end in it.
struct Waits {
  double least = 0.0, mean = 0.0, batches = 0.0;
};

// Of the samples from `first` on for kLook_s, forwards or backwards; `late_ns` is each sample's time less its count of
// periods.
Waits waits_from(const std::vector<double>& t_ns, const std::vector<double>& late_ns, const std::vector<char>& ends,
                 std::size_t first, bool forwards) {
  Waits out{late_ns[first], 0.0, 1.0};
  double count = 0.0;
  for (std::size_t i = first; std::abs(t_ns[i] - t_ns[first]) < 1e9 * kLook_s; i += forwards ? 1 : -1) {
    out.least = std::min(out.least, late_ns[i]);
    out.mean += late_ns[i];
    out.batches += ends[i];
    count += 1.0;
    if (forwards ? i + 1 == t_ns.size() : i == 0) break;
  }
  out.mean /= count;
  return out;
}

// How many samples were lost just before each one.
std::vector<double> find_losses(const std::vector<double>& t_ns, const std::vector<double>& step_ns,
                                const Batches& batches) {
  const std::size_t n = t_ns.size();
  const double period = batches.period_ns;
  std::vector<double> late_ns(n), lost(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) late_ns[i] = t_ns[i] - period * static_cast<double>(i);
  double before = 0.0;  // lost up to sample i; `late_ns` has it taken off up to there
  for (std::size_t i = 1; i < n; ++i) {
    if (step_ns[i - 1] > kLongStep * period) {
      const Waits behind = waits_from(t_ns, late_ns, batches.ends, i - 1, false);
      const Waits ahead = waits_from(t_ns, late_ns, batches.ends, i, true);
      const double shift = ahead.least - before * period - behind.least;
      const double by_chance = kWaits * (behind.mean - behind.least) / std::min(behind.batches, ahead.batches);
      if (shift > std::max(kLost * period, by_chance)) {
        // The batch may have waited as well, and the loss be in its midst: from there on all are late by the whole of
        // it, and the step itself is a whole one.
        std::size_t at = i;
        double most = shift, best = std::abs(step_ns[i - 1] / period - 1.0 - std::round(shift / period));
        for (std::size_t j = i + 1; j < n && t_ns[j] - t_ns[i] < kBatch_ns; ++j) {
          if (step_ns[j - 1] < kLongStep * period) continue;
          const double later = waits_from(t_ns, late_ns, batches.ends, j, true).least - before * period - behind.least;
          const double misfit = std::abs(step_ns[j - 1] / period - 1.0 - std::round(later / period));
          if (later < most - 0.5 * period || (later < most + 0.5 * period && (best < kExact || misfit > kExact)))
            continue;
          most = later, best = misfit, at = j;
        }
        const double count = std::max(1.0, std::round(most / period));
        for (; i < at; ++i) late_ns[i] -= before * period;
        lost[at] = count;
        before += count;
      }
    }
    late_ns[i] -= before * period;
  }
  return lost;
}

// The straight line through the batches' lateness over their counts within ± reach of a node, at the node. Batches that
// waited unusually long are left out.
double line_at(std::span<const double> count, std::span<const double> late_ns, double node) {
  const std::vector<double> all(late_ns.begin(), late_ns.end());
  const double middle = median(all);
  const double most = kSigmas * std::max(scatter_about(all, middle), 1.0);
  double s0 = 0.0, sx = 0.0, sxx = 0.0, sy = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (std::abs(late_ns[i] - middle) > most) continue;
    const double x = count[i] - node, y = late_ns[i] - middle;
    s0 += 1.0, sx += x, sxx += x * x, sy += y, sxy += x * y;
  }
  const double determinant = s0 * sxx - sx * sx;
  if (s0 < 3.0 || !(determinant > 1e-9 * s0 * sxx)) return middle + (s0 > 0.0 ? sy / s0 : 0.0);
  return middle + (sy * sxx - sx * sxy) / determinant;
}

// The clock's lateness at each count, by lines at nodes and between them.
std::vector<double> fit_clock(const std::vector<double>& count, const std::vector<double>& late_ns,
                              const std::vector<char>& ends, double period_ns, double reach_s) {
  std::vector<double> at, late;
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (ends[i] != 0) at.push_back(count[i]), late.push_back(late_ns[i]);
  }
  const double step = 1e9 * kNode_s / period_ns, reach = 1e9 * reach_s / period_ns;
  std::vector<double> out(count.size());
  double node = 0.0, here = 0.0, next = 0.0;
  std::size_t first = 0, last = 0;
  const auto fit = [&](double x) {
    // Where no batch ends within reach, the next one counts.
    while (last < at.size() && (last == first || at[last] <= x + reach)) ++last;
    while (first + 8 < last && at[first] < x - reach) ++first;
    return line_at(std::span(at).subspan(first, last - first), std::span(late).subspan(first, last - first), x);
  };
  here = fit(node);
  next = fit(node + step);
  for (std::size_t i = 0; i < count.size(); ++i) {
    while (count[i] > node + step) {
      node += step;
      here = next;
      next = fit(node + step);
    }
    out[i] = here + (count[i] - node) / step * (next - here);
  }
  return out;
}

}  // namespace

std::optional<SmoothClockResult> smooth_batches(const std::vector<std::int64_t>& t_ns, double reach_s) {
  const std::size_t n = t_ns.size();
  if (n < 2) return std::nullopt;
  std::vector<double> since_ns(n), step_ns(n - 1), count(n, 0.0), late_ns(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) since_ns[i] = static_cast<double>(t_ns[i] - t_ns[0]);
  for (std::size_t i = 1; i < n; ++i) step_ns[i - 1] = since_ns[i] - since_ns[i - 1];
  const Batches batches = find_batches(since_ns, step_ns);
  if (!(batches.period_ns > 0.0)) return std::nullopt;
  const std::vector<double> lost = find_losses(since_ns, step_ns, batches);
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) count[i] = count[i - 1] + 1.0 + lost[i];
    late_ns[i] = since_ns[i] - batches.period_ns * count[i];
  }
  const std::vector<double> clock = fit_clock(count, late_ns, batches.ends, batches.period_ns, reach_s);
  SmoothClockResult out;
  out.t_ns.resize(n);
  double square = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    out.t_ns[i] = t_ns[0] + std::llround(batches.period_ns * count[i] + clock[i]);
    square += (late_ns[i] - clock[i]) * (late_ns[i] - clock[i]);
  }
  if (std::adjacent_find(out.t_ns.begin(), out.t_ns.end(), std::greater_equal<>()) != out.t_ns.end()) {
    return std::nullopt;
  }
  out.period_s = 1e-9 * static_cast<double>(out.t_ns.back() - out.t_ns.front()) / count.back();
  out.jitter_s = 1e-9 * std::sqrt(square / static_cast<double>(n));
  out.applied = true;
  return out;
}

}  // namespace asperity
