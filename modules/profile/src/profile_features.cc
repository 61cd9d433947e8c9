#include "profile_features.h"

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

// A part of the profile on one side of the mean line, between two crossings (in samples).
struct Portion {
  double start = 0.0;
  double end = 0.0;
  double height_m = 0.0;  // the largest distance from the mean line
  bool hill = false;
  bool cut = false;  // by an end of the profile

  double width() const { return end - start; }
};

std::vector<Portion> portions_between_crossings(std::span<const double> z, const Observer& observer) {
  RowWatch watch(observer);
  std::vector<Portion> portions;
  // Samples on the mean line belong to the portion before them; leading ones to the first.
  std::size_t first = 0;
  while (first < z.size() && z[first] == 0.0) ++first;
  if (first == z.size()) return portions;
  Portion current{0.0, 0.0, 0.0, z[first] > 0.0, true};
  std::size_t last_off_line = first;
  for (std::size_t i = first; i < z.size(); ++i) {
    watch.next();
    if (z[i] == 0.0) continue;
    if ((z[i] > 0.0) != current.hill) {
      // Over a run of zeros the crossing is its middle; otherwise where the straight line cuts zero.
      const double from = static_cast<double>(last_off_line);
      const double to = static_cast<double>(i);
      const double fraction = i - last_off_line > 1 ? 0.5 : z[last_off_line] / (z[last_off_line] - z[i]);
      current.end = from + fraction * (to - from);
      portions.push_back(current);
      current = Portion{current.end, 0.0, 0.0, z[i] > 0.0, false};
    }
    current.height_m = std::max(current.height_m, std::abs(z[i]));
    last_off_line = i;
  }
  current.end = static_cast<double>(z.size() - 1);
  current.cut = true;
  portions.push_back(current);
  return portions;
}

// Drops the portions that `keep` refuses and joins the neighbours of equal side that then meet. Where a
// hill and a pit meet over dropped portions, they meet in the middle of the crossings between them.
template <class Keep>
std::vector<Portion> join_over_dropped(const std::vector<Portion>& portions, const Observer& observer,
                                       const Keep& keep) {
  RowWatch watch(observer);
  std::vector<Portion> joined;
  for (const Portion& portion : portions) {
    watch.next();
    if (!keep(portion)) continue;
    if (joined.empty()) {
      joined.push_back(portion);
    } else if (joined.back().hill == portion.hill) {
      Portion& last = joined.back();
      last.end = portion.end;
      last.height_m = std::max(last.height_m, portion.height_m);
      last.cut = last.cut || portion.cut;
    } else {
      const double meeting = 0.5 * (joined.back().end + portion.start);
      joined.back().end = meeting;
      joined.push_back(portion);
      joined.back().start = meeting;
    }
  }
  return joined;
}

}  // namespace

std::vector<std::span<const double>> gap_free_stretches(std::span<const double> height_m) {
  std::vector<std::span<const double>> stretches;
  std::size_t start = 0;
  for (std::size_t i = 0; i <= height_m.size(); ++i) {
    if (i < height_m.size() && !std::isnan(height_m[i])) continue;
    if (i > start) stretches.push_back(height_m.subspan(start, i - start));
    start = i + 1;
  }
  return stretches;
}

void ElementWidths::add(const ElementWidths& more) {
  sum_m += more.sum_m;
  count += more.count;
  sum_height_m += more.sum_height_m;
  highest_m = std::max(highest_m, more.highest_m);
  sum_square_m2 += more.sum_square_m2;
  widest_m = std::max(widest_m, more.widest_m);
  sum_square_height_m2 += more.sum_square_height_m2;
}

ElementWidths element_widths(std::span<const double> stretch_m, double spacing_m, double min_height_m,
                             double min_width_m, const Observer& observer) {
  ElementWidths widths;
  const double min_width = min_width_m / spacing_m;
  auto portions = portions_between_crossings(stretch_m, observer);
  portions = join_over_dropped(portions, observer, [&](const Portion& p) { return p.height_m >= min_height_m; });
  // How wide a portion is that an end cuts off is not known: it stays, and closes no element.
  portions = join_over_dropped(portions, observer, [&](const Portion& p) { return p.cut || p.width() >= min_width; });
  for (std::size_t i = 1; i + 2 < portions.size(); ++i) {
    const double width_m = (portions[i + 1].end - portions[i].start) * spacing_m;
    widths.sum_m += width_m;
    widths.sum_square_m2 += width_m * width_m;
    widths.widest_m = std::max(widths.widest_m, width_m);
    ++widths.count;
    const double height_m = portions[i].height_m + portions[i + 1].height_m;
    widths.sum_height_m += height_m;
    widths.sum_square_height_m2 += height_m * height_m;
    widths.highest_m = std::max(widths.highest_m, height_m);
  }
  return widths;
}

void append_peaks_and_pits(std::span<const double> stretch_m, double prominence_m, PeaksAndPits& found,
                           const Observer& observer) {
  RowWatch watch(observer);
  if (stretch_m.empty()) return;
  const double* lowest = &stretch_m[0];
  const double* highest = lowest;
  enum class Seeking { kEither, kPeak, kPit } seeking = Seeking::kEither;
  for (const double& z : stretch_m) {
    watch.next();
    if (z < *lowest) lowest = &z;
    if (z > *highest) highest = &z;
    if (seeking != Seeking::kPit && z < *highest && *highest - z >= prominence_m) {
      // Found first, the peak had no rise before it that is known to be high enough.
      if (seeking == Seeking::kPeak) {
        found.peak_m.push_back(*highest);
        found.peak.push_back(highest);
      }
      seeking = Seeking::kPit;
      lowest = &z;
    } else if (seeking != Seeking::kPeak && z > *lowest && z - *lowest >= prominence_m) {
      if (seeking == Seeking::kPit) {
        found.pit_m.push_back(*lowest);
        found.pit.push_back(lowest);
      }
      seeking = Seeking::kPeak;
      highest = &z;
    }
  }
}

}  // namespace asperity
