#include "asperity/signal/resample.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

void check_samples(std::span<const double> t, std::span<const double> x) {
  if (t.size() != x.size()) {
    throw Error("resampling: " + std::to_string(t.size()) + " times but " + std::to_string(x.size()) + " values");
  }
  if (!t.empty() && std::isnan(t[0])) throw Error("resampling: time 0 is nan");
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (!(t[i] >= t[i - 1])) {
      throw Error("resampling: time " + std::to_string(i) + " (" + number_text(t[i]) + ") is not after " +
                  number_text(t[i - 1]));
    }
  }
}

template <class At>
std::vector<double> interpolate_rising(std::span<const double> t, std::span<const double> x, std::size_t count,
                                       double max_step, At at) {
  std::vector<double> out(count, kNan);
  std::size_t k = 0;  // t[k] <= point < t[k+1]
  for (std::size_t i = 0; i < count; ++i) {
    const double point = at(i);
    if (t.empty() || !(point >= t.front() && point <= t.back())) continue;
    if (point == t.back()) {
      out[i] = x.back();
      continue;
    }
    // One step without a branch first: whether there is a sample between two points is unpredictable.
    k += static_cast<std::size_t>(t[k + 1] <= point);
    while (t[k + 1] <= point) ++k;
    const double step = t[k + 1] - t[k];
    if (t[k] == point) {
      out[i] = x[k];
    } else if (step <= max_step) {
      out[i] = x[k] + (x[k + 1] - x[k]) * ((point - t[k]) / step);
    }
  }
  return out;
}

template <class Time>
std::vector<double> bridge_gaps(std::span<const double> x, Time t) {
  std::vector<double> out(x.begin(), x.end());
  std::size_t next = 0;  // first index not yet looked at
  while (next < x.size()) {
    if (!std::isnan(x[next])) {
      ++next;
      continue;
    }
    const std::size_t begin = next;
    while (next < x.size() && std::isnan(x[next])) ++next;
    const bool has_left = begin > 0;
    const bool has_right = next < x.size();
    for (std::size_t i = begin; i < next && (has_left || has_right); ++i) {
      if (!has_left) {
        out[i] = x[next];
      } else if (!has_right) {
        out[i] = x[begin - 1];
      } else {
        const double span = t(next) - t(begin - 1);
        const double part = span > 0.0 ? (t(i) - t(begin - 1)) / span : 0.0;
        out[i] = x[begin - 1] + (x[next] - x[begin - 1]) * part;
      }
    }
  }
  return out;
}

}  // namespace

std::vector<double> resample_uniform(std::span<const double> t, std::span<const double> x, double start, double spacing,
                                     std::size_t count, double max_step) {
  check_samples(t, x);
  if (!(spacing > 0.0)) throw Error("resampling: spacing must be positive, not " + number_text(spacing));
  return interpolate_rising(t, x, count, max_step,
                            [=](std::size_t i) { return start + static_cast<double>(i) * spacing; });
}

std::vector<double> interpolate(std::span<const double> t, std::span<const double> x, std::span<const double> at,
                                double max_step) {
  check_samples(t, x);
  for (std::size_t i = 1; i < at.size(); ++i) {
    if (!(at[i] >= at[i - 1])) throw Error("resampling: point " + std::to_string(i) + " is not after the one before");
  }
  return interpolate_rising(t, x, at.size(), max_step, [=](std::size_t i) { return at[i]; });
}

std::vector<double> interval_means(std::span<const double> t, std::span<const double> x, std::span<const double> at,
                                   double width) {
  check_samples(t, x);
  if (!(width > 0.0)) throw Error("resampling: width must be positive, not " + number_text(width));
  std::vector<double> integral(t.size(), 0.0);
  for (std::size_t i = 1; i < t.size(); ++i) {
    integral[i] = integral[i - 1] + 0.5 * (x[i] + x[i - 1]) * (t[i] - t[i - 1]);
  }
  // The integral up to `point`; `k` follows rising points.
  const auto integral_to = [&](double point, std::size_t& k) {
    while (k + 1 < t.size() && t[k + 1] <= point) ++k;
    const double part = point - t[k];
    if (part <= 0.0 || k + 1 == t.size()) return integral[k];
    const double slope = (x[k + 1] - x[k]) / (t[k + 1] - t[k]);
    return integral[k] + part * (x[k] + 0.5 * slope * part);
  };
  std::vector<double> out;
  out.reserve(at.size());
  std::size_t k_begin = 0, k_end = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (i > 0 && !(at[i] >= at[i - 1])) {
      throw Error("resampling: point " + std::to_string(i) + " is not after the one before");
    }
    const double begin = t.empty() ? 0.0 : std::max(t.front(), at[i] - 0.5 * width);
    const double end = t.empty() ? 0.0 : std::min(t.back(), at[i] + 0.5 * width);
    if (!(end > begin)) throw Error("resampling: no samples around point " + number_text(at[i]));
    const double low = integral_to(begin, k_begin);
    out.push_back((integral_to(end, k_end) - low) / (end - begin));
  }
  return out;
}

std::vector<double> bridge_gaps(std::span<const double> t, std::span<const double> x) {
  check_samples(t, x);
  return bridge_gaps(x, [=](std::size_t i) { return t[i]; });
}

std::vector<double> bridge_gaps(std::span<const double> x) {
  return bridge_gaps(x, [](std::size_t i) { return static_cast<double>(i); });
}

}  // namespace asperity
