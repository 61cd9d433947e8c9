#include "window.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asperity/base/smoothstep.h"

namespace asperity {
namespace {

template <class Visit>
void for_each_stretch(const std::vector<double>& z, const Visit& visit) {
  std::size_t start = 0;
  for (std::size_t i = 0; i <= z.size(); ++i) {
    if (i < z.size() && !std::isnan(z[i])) continue;
    if (i > start) visit(start, i);
    start = i + 1;
  }
}

// Running sums of z and z² over present samples, for the variance of any window.
struct Moments {
  std::vector<double> sum;
  std::vector<double> square;
  double mean = 0.0;
  double rms = 0.0;

  explicit Moments(const std::vector<double>& z) : sum(z.size() + 1, 0.0), square(z.size() + 1, 0.0) {
    double count = 0.0;
    for (const double v : z) {
      if (std::isnan(v)) continue;
      mean += v;
      count += 1.0;
    }
    mean /= std::max(count, 1.0);
    for (std::size_t i = 0; i < z.size(); ++i) {
      const double v = std::isnan(z[i]) ? 0.0 : z[i] - mean;
      sum[i + 1] = sum[i] + v;
      square[i + 1] = square[i] + v * v;
    }
    rms = std::sqrt(square.back() / std::max(count, 1.0));
  }

  double window_rms(std::size_t first, std::size_t count) const {
    const double n = static_cast<double>(count);
    const double m = (sum[first + count] - sum[first]) / n;
    return std::sqrt(std::max(0.0, (square[first + count] - square[first]) / n - m * m));
  }
};

// Mean square by which the profile about the window's end differs from the profile about its start.
double seam_mismatch(const std::vector<double>& z, const Window& w, std::size_t seam) {
  const std::size_t before = std::min(seam, w.first - w.stretch_first);
  const std::size_t after = std::min(seam, w.stretch_end - (w.first + w.count));
  if (before + after == 0) {
    const double jump = z[w.first] - z[w.first + w.count - 1];
    return jump * jump;
  }
  double sum = 0.0;
  for (std::size_t i = w.first - before; i < w.first + after; ++i) {
    const double difference = z[i + w.count] - z[i];
    sum += difference * difference;
  }
  return sum / static_cast<double>(before + after);
}

}  // namespace

BridgedProfile bridge_short_gaps(std::span<const double> height_m, std::size_t max_gap) {
  BridgedProfile profile{{height_m.begin(), height_m.end()}, std::vector<std::size_t>(height_m.size() + 1, 0)};
  auto& z = profile.height_m;
  std::vector<bool> bridged(z.size(), false);
  std::size_t gap_start = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (std::isnan(z[i])) continue;
    const std::size_t gap = i - gap_start;
    if (gap > 0 && gap <= max_gap && gap_start > 0) {
      const double from = z[gap_start - 1];
      const double step = (z[i] - from) / static_cast<double>(gap + 1);
      for (std::size_t k = 0; k < gap; ++k) {
        z[gap_start + k] = from + static_cast<double>(k + 1) * step;
        bridged[gap_start + k] = true;
      }
    }
    gap_start = i + 1;
  }
  for (std::size_t i = 0; i < z.size(); ++i)
    profile.bridged_before[i + 1] = profile.bridged_before[i] + (bridged[i] ? 1 : 0);
  return profile;
}

Window best_window(const BridgedProfile& profile, std::size_t count, std::size_t seam) {
  const auto& z = profile.height_m;
  const Moments moments(z);
  Window best;
  std::size_t fewest = 0;
  double lowest = std::numeric_limits<double>::infinity();
  for_each_stretch(z, [&](std::size_t start, std::size_t end) {
    for (std::size_t first = start; first + count <= end; ++first) {
      const std::size_t bridged = profile.bridged_before[first + count] - profile.bridged_before[first];
      if (best.found() && bridged > fewest) continue;
      const Window window{first, count, start, end};
      const double rms_excess = moments.window_rms(first, count) - moments.rms;
      const double cost = seam_mismatch(z, window, seam) + rms_excess * rms_excess;
      if (best.found() && bridged == fewest && !(cost < lowest)) continue;
      best = window;
      fewest = bridged;
      lowest = cost;
    }
  });
  return best;
}

Window longest_stretch(const BridgedProfile& profile) {
  Window longest;
  for_each_stretch(profile.height_m, [&](std::size_t start, std::size_t end) {
    if (end - start > longest.count) longest = {start, end - start, start, end};
  });
  return longest;
}

std::vector<double> close_seam(const BridgedProfile& profile, const Window& window, std::size_t seam) {
  const auto begin = profile.height_m.begin() + static_cast<std::ptrdiff_t>(window.first);
  std::vector<double> z(begin, begin + static_cast<std::ptrdiff_t>(window.count));
  seam = std::min(seam, window.count / 2);
  const std::size_t before = window.first - window.stretch_first;
  const std::size_t after = window.stretch_end - (window.first + window.count);
  const double jump = z.front() - z.back();
  for (std::size_t k = 0; k < seam; ++k) {
    // From near 0 at the seam to near 1 where the window is itself again.
    const double own = smoothstep(static_cast<double>(k + 1) / static_cast<double>(seam + 1));
    double& at_start = z[k];
    double& at_end = z[window.count - 1 - k];
    if (after >= seam) {
      at_start += (1.0 - own) * (profile.height_m[window.first + window.count + k] - at_start);
    } else if (before >= seam) {
      at_end += (1.0 - own) * (profile.height_m[window.first - 1 - k] - at_end);
    } else {
      at_start -= 0.5 * jump * (1.0 - own);
      at_end += 0.5 * jump * (1.0 - own);
    }
  }
  return z;
}

}  // namespace asperity
