#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>

#include "asperity/base/nan.h"
#include "fft.h"
#include "spline.h"
#include "true_figures.h"

namespace bench {

namespace {

using asperity::kNan;

constexpr double kHole_m = 0.6e-3;
constexpr double kReach_m = 1e-3;  // of the shift

// Read at rising queries: y at x by straight lines, held at the ends.
class Line {
 public:
  Line(const std::vector<double>& x, const std::vector<double>& y) : x_(x), y_(y) {}
  double at(double x) const {
    const auto above = std::upper_bound(x_.begin(), x_.end(), x);
    if (above == x_.begin()) return y_.front();
    if (above == x_.end()) return y_.back();
    const auto b = static_cast<std::size_t>(above - x_.begin());
    const double share = (x - x_[b - 1]) / (x_[b] - x_[b - 1]);
    return y_[b - 1] + share * (y_[b] - y_[b - 1]);
  }

 private:
  const std::vector<double>&x_, &y_;
};

// The true heights over the true arc length: means over 6 µm, without flights longer than 20 ms.
Spline true_heights(const asperity::Truth& truth, const std::vector<double>& t_s) {
  constexpr double kCell_m = 6.25e-6;
  constexpr double kBounce_s = 0.02;
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < truth.size();) {
    std::size_t end = i;
    while (end < truth.size() && truth.force_N[end] <= 0.0) ++end;
    if (end > i && t_s[end - 1] - t_s[i] > kBounce_s) {
      i = end;
      continue;
    }
    for (end = std::max(end, i + 1); i < end; ++i) {
      if (std::isfinite(truth.s_m[i]) && std::isfinite(truth.height_m[i]))
        points.emplace_back(truth.s_m[i], truth.height_m[i]);
    }
  }
  std::sort(points.begin(), points.end());
  std::vector<double> s_m, height_m;
  for (std::size_t i = 0; i < points.size();) {
    const double end_m = points[i].first + kCell_m;
    double sum_s = 0.0, sum_h = 0.0, count = 0.0;
    for (; i < points.size() && points[i].first < end_m; ++i) {
      sum_s += points[i].first;
      sum_h += points[i].second;
      count += 1.0;
    }
    s_m.push_back(sum_s / count);
    height_m.push_back(sum_h / count);
  }
  return {std::move(s_m), std::move(height_m), kHole_m};
}

double correlation(std::span<const double> a, std::span<const double> b) {
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
    ab += a[i] * b[i];
    aa += a[i] * a[i];
    bb += b[i] * b[i];
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

// Less the least-squares line over the point's number.
void subtract_line(std::vector<double>& y) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (!std::isfinite(y[i])) continue;
    const auto x = static_cast<double>(i);
    n += 1.0;
    sx += x;
    sy += y[i];
    sxx += x * x;
    sxy += x * y[i];
  }
  const double spread = n * sxx - sx * sx;
  if (!(spread > 0.0)) return;
  const double slope = (n * sxy - sx * sy) / spread;
  const double level = (sy - slope * sx) / n;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] -= level + slope * static_cast<double>(i);
}

std::vector<double> high_pass_run(std::vector<double> run, double cutoff_per_sample) {
  subtract_line(run);
  const std::size_t n = run.size();
  const std::size_t pad = std::min(n - 1, static_cast<std::size_t>(2.0 / cutoff_per_sample));
  std::size_t size = 1;
  while (size < n + 2 * pad) size <<= 1;
  std::vector<std::complex<double>> x(size, 0.0);
  for (std::size_t i = 0; i < n + 2 * pad; ++i) {
    const auto at = static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(pad);
    const auto last = static_cast<std::ptrdiff_t>(n) - 1;
    const auto mirrored = at < 0 ? -at : at > last ? 2 * last - at : at;
    x[i] = run[static_cast<std::size_t>(mirrored)];
  }
  // What is beyond the mirrored ends falls smoothly to the beginning, which the circle of the transform joins.
  const std::size_t filled = n + 2 * pad;
  for (std::size_t i = filled; i < size; ++i) {
    const double share = static_cast<double>(i - filled + 1) / static_cast<double>(size - filled + 1);
    x[i] = x[filled - 1] + share * (x[0] - x[filled - 1]);
  }
  fft(x, -1);
  for (std::size_t k = 0; k < size; ++k) {
    const double f = static_cast<double>(std::min(k, size - k)) / static_cast<double>(size);
    const double ratio = f > 0.0 ? cutoff_per_sample / f : 0.0;
    const double gain = f > 0.0 ? 1.0 / (1.0 + (std::sqrt(2.0) - 1.0) * ratio * ratio * ratio * ratio) : 0.0;
    x[k] *= gain / static_cast<double>(size);
  }
  fft(x, 1);
  for (std::size_t i = 0; i < n; ++i) run[i] = x[i + pad].real();
  return run;
}

// The time at which the measured path passed each of s_m.
std::vector<double> times_at(const asperity::ProcessResult& result, std::int64_t origin_ns,
                             const std::vector<double>& s_m) {
  const asperity::TipMotion& motion = result.trajectory.motion;
  std::vector<double> path_m, t_s;
  for (std::size_t i = 0; i < result.base.path.size(); ++i) {
    if (!result.base.contact.empty() && result.base.contact[i] == 0) continue;
    // A rest before the path is passed when it ends.
    if (path_m.size() == 1 && result.base.path.s_m[i] == path_m.back()) path_m.clear(), t_s.clear();
    if (!path_m.empty() && !(result.base.path.s_m[i] > path_m.back())) continue;
    path_m.push_back(result.base.path.s_m[i]);
    t_s.push_back(1e-9 * static_cast<double>(motion.t_ns[i] - origin_ns));
  }
  std::vector<double> out(s_m.size(), kNan);
  if (path_m.size() < 2) return out;
  const Line line(path_m, t_s);
  std::transform(s_m.begin(), s_m.end(), out.begin(), [&](double s) { return line.at(s); });
  return out;
}

// From where the tip truly was in the first tenth of a second in contact to where it was in the last, by medians: about
// a period of the hand's tremor. Not between the times at which the measured path first passed its ends: noise passes
// the place of a rest before the tip is there. Nor from the lowest to the highest true place: tremor at rest, as noise,
// makes these too far apart.
double true_length_m(const asperity::ProcessResult& result, std::int64_t origin_ns, const asperity::Truth& truth,
                     const std::vector<double>& t_s) {
  constexpr double kEnd_s = 0.1;
  const asperity::TipMotion& motion = result.trajectory.motion;
  const std::vector<char>& contact = result.base.contact;
  std::size_t first = 0, last = motion.size();
  while (first < last && !contact.empty() && contact[first] == 0) ++first;
  while (last > first && !contact.empty() && contact[last - 1] == 0) --last;
  if (first == last) return kNan;
  const auto seconds = [&](std::size_t i) { return 1e-9 * static_cast<double>(motion.t_ns[i] - origin_ns); };
  const auto median_between = [&](double from_s, double to_s) {
    std::vector<double> s_m;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (t_s[i] >= from_s && t_s[i] <= to_s) s_m.push_back(truth.s_m[i]);
    }
    if (s_m.empty()) return kNan;
    const auto middle = s_m.begin() + static_cast<std::ptrdiff_t>(s_m.size() / 2);
    std::nth_element(s_m.begin(), middle, s_m.end());
    return *middle;
  };
  const double begin_s = seconds(first), end_s = seconds(last - 1);
  return median_between(end_s - kEnd_s, end_s) - median_between(begin_s, begin_s + kEnd_s);
}

}  // namespace

std::vector<double> high_pass(std::span<const double> height_m, double spacing_m, double cutoff_cycles_per_mm,
                              double bridge_m) {
  std::vector<double> out(height_m.size(), kNan);
  const auto bridge = static_cast<std::size_t>(std::lround(bridge_m / spacing_m));
  for (std::size_t first = 0; first < height_m.size(); ++first) {
    if (!std::isfinite(height_m[first])) continue;
    std::size_t last = first;
    for (std::size_t i = first + 1; i < height_m.size() && i - last <= bridge + 1; ++i) {
      if (std::isfinite(height_m[i])) last = i;
    }
    std::vector<double> run;
    for (std::size_t i = first; i <= last; ++i) {
      if (std::isfinite(height_m[i])) {
        run.push_back(height_m[i]);
        continue;
      }
      std::size_t next = i;
      while (!std::isfinite(height_m[next])) ++next;
      run.push_back(run.back() + (height_m[next] - run.back()) / static_cast<double>(next - i + 1));
    }
    if (run.size() >= 8) {
      run = high_pass_run(std::move(run), cutoff_cycles_per_mm * 1e3 * spacing_m);
      for (std::size_t i = first; i <= last; ++i) {
        if (std::isfinite(height_m[i])) out[i] = run[i - first];
      }
    }
    first = last;
  }
  return out;
}

TrueProfile find_true_profile(const asperity::Recording& recording, const asperity::ProcessResult& result,
                              std::span<const double> measured_texture_m) {
  TrueProfile out;
  const asperity::Profile& profile = result.profile;
  if (!recording.truth || profile.size() < 16 || result.base.path.size() == 0) return out;
  const asperity::Truth& truth = *recording.truth;
  const std::int64_t origin_ns = truth.t_ns.front();
  std::vector<double> t_s(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) t_s[i] = 1e-9 * static_cast<double>(truth.t_ns[i] - origin_ns);
  if (!std::isfinite(truth.s_m.front())) return out;

  const Line true_s(t_s, truth.s_m);
  const std::vector<double> passed_s = times_at(result, origin_ns, profile.s_m);
  std::vector<double> at_m(profile.size());
  std::transform(passed_s.begin(), passed_s.end(), at_m.begin(), [&](double t) { return true_s.at(t); });
  out.length_m = true_length_m(result, origin_ns, truth, t_s);

  const Spline heights = true_heights(truth, t_s);
  const double cutoff = result.config.profile.cutoff_cycles_per_mm, bridge_m = result.config.profile.bridge_m;
  const auto shifted = [&](double shift_m) {
    std::vector<double> h(profile.size(), kNan);
    for (std::size_t i = 0; i < h.size(); ++i) {
      if (std::isfinite(profile.height_m[i])) h[i] = heights.at(at_m[i] + shift_m);
    }
    return h;
  };
  const auto texture = [&](double shift_m) { return high_pass(shifted(shift_m), profile.spacing_m, cutoff, bridge_m); };
  // On the grid by one filtered truth, then by a parabola.
  const std::vector<double> unshifted = texture(0.0);
  const auto reach = static_cast<std::ptrdiff_t>(kReach_m / profile.spacing_m);
  const auto at_shift = [&](std::ptrdiff_t k) {
    const std::size_t n = unshifted.size(), by = static_cast<std::size_t>(std::abs(k));
    if (by + 8 > n) return 0.0;
    const std::span<const double> a(unshifted), b(profile.texture_m);
    return k >= 0 ? correlation(a.subspan(by), b.first(n - by)) : correlation(a.first(n - by), b.subspan(by));
  };
  std::ptrdiff_t best = 0;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) best = at_shift(k) > at_shift(best) ? k : best;
  const double before = at_shift(best - 1), middle = at_shift(best), after = at_shift(best + 1);
  const double bend = before - 2.0 * middle + after;
  const double part = bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
  out.shift_m = (static_cast<double>(best) + part) * profile.spacing_m;

  // What a reader has: a height at a place along the measured path, not the time at which the tip passed there.
  std::vector<double> offset_m(profile.size());
  for (std::size_t i = 0; i < profile.size(); ++i) offset_m[i] = at_m[i] - profile.s_m[i];
  const auto half = offset_m.begin() + static_cast<std::ptrdiff_t>(offset_m.size() / 2);
  std::nth_element(offset_m.begin(), half, offset_m.end());
  std::vector<double> placed_m(profile.size(), kNan);
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (std::isfinite(profile.height_m[i])) placed_m[i] = heights.at(profile.s_m[i] + *half + out.shift_m);
  }
  const std::vector<double> placed_texture_m = high_pass(placed_m, profile.spacing_m, cutoff, bridge_m);

  out.height_m = shifted(out.shift_m);
  out.texture_m = high_pass(out.height_m, profile.spacing_m, cutoff, bridge_m);
  out.error_m.resize(profile.size());
  out.texture_error_m.resize(profile.size());
  out.measured_error_m.resize(profile.size());
  out.placed_texture_error_m.resize(profile.size());
  for (std::size_t i = 0; i < profile.size(); ++i) {
    out.error_m[i] = profile.height_m[i] - placed_m[i];
    out.texture_error_m[i] = profile.texture_m[i] - out.texture_m[i];
    out.measured_error_m[i] = measured_texture_m[i] - out.texture_m[i];
    out.placed_texture_error_m[i] = profile.texture_m[i] - placed_texture_m[i];
  }
  subtract_line(out.error_m);
  return out;
}

}  // namespace bench
