#include "relief_level.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace asperity::registration {

namespace {

constexpr std::size_t kLeast = 20;
constexpr int kRounds = 6;
constexpr double kShare = 0.3;   // of the way, in the shortest interval of heights
constexpr double kFlat = 0.3;    // of the RMS about the face: the interval of a face is shorter
constexpr double kMargin = 0.5;  // of the interval, on either side of it
constexpr double kEither = 0.5;  // of the face's distance from the mean: the mesh has the one or the other

// Each height over the mean of those of the face in the window about it; of all heights there if none is of the face.
std::vector<double> over_face(std::span<const double> d_m, std::span<const double> u_m, double window_m,
                              const std::vector<char>& face) {
  std::vector<double> out(d_m.size(), 0.0);
  double sum_m = 0.0, count = 0.0, face_sum_m = 0.0, face_count = 0.0;
  std::size_t first = 0, last = 0;
  const auto add = [&](std::size_t k, double sign) {
    sum_m += sign * d_m[k];
    count += sign;
    if (face[k] == 0) return;
    face_sum_m += sign * d_m[k];
    face_count += sign;
  };
  for (std::size_t i = 0; i < d_m.size(); ++i) {
    while (last < d_m.size() && u_m[last] <= u_m[i] + 0.5 * window_m) add(last++, 1.0);
    while (u_m[first] < u_m[i] - 0.5 * window_m) add(first++, -1.0);
    out[i] = d_m[i] - (face_count > 0.5 ? face_sum_m / face_count : sum_m / count);
  }
  return out;
}

struct Interval {
  double low_m = 0.0, high_m = 0.0;
};

// The shortest with kShare of the way; `way_m`: what each height stands for.
Interval shortest_interval(const std::vector<double>& h_m, const std::vector<double>& way_m) {
  std::vector<std::pair<double, double>> sorted;
  double total_m = 0.0, held_m = 0.0;
  for (std::size_t i = 0; i < h_m.size(); ++i) {
    sorted.emplace_back(h_m[i], way_m[i]);
    total_m += way_m[i];
  }
  std::sort(sorted.begin(), sorted.end());
  Interval out{sorted.front().first, sorted.back().first};
  for (std::size_t low = 0, high = 0; high < sorted.size(); ++high) {
    held_m += sorted[high].second;
    while (low < high && held_m - sorted[low].second >= kShare * total_m) held_m -= sorted[low++].second;
    const double length_m = sorted[high].first - sorted[low].first;
    if (held_m >= kShare * total_m && length_m < out.high_m - out.low_m) {
      out = {sorted[low].first, sorted[high].first};
    }
  }
  return out;
}

double rms_about(const std::vector<double>& h_m, double middle_m) {
  double square_m2 = 0.0;
  for (const double h : h_m) square_m2 += (h - middle_m) * (h - middle_m);
  return std::sqrt(square_m2 / static_cast<double>(h_m.size()));
}

}  // namespace

ReliefLevel measure_relief_level(std::span<const double> d_m, std::span<const double> u_m, double window_m) {
  ReliefLevel out;
  if (d_m.empty()) return out;
  std::vector<char> face(d_m.size(), 1);
  std::vector<double> h_m = over_face(d_m, u_m, window_m, face);
  out.sigma_m = rms_about(h_m, 0.0);
  if (d_m.size() < kLeast || !(u_m.back() > u_m.front())) return out;
  std::vector<double> way_m(d_m.size());
  for (std::size_t i = 0; i < way_m.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, way_m.size() - 1);
    way_m[i] = std::min(0.5 * (u_m[after] - u_m[before]), window_m);
  }
  Interval at;
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) h_m = over_face(d_m, u_m, window_m, face);
    at = shortest_interval(h_m, way_m);
    const double margin_m = kMargin * (at.high_m - at.low_m);
    for (std::size_t i = 0; i < face.size(); ++i) {
      face[i] = h_m[i] >= at.low_m - margin_m && h_m[i] <= at.high_m + margin_m ? 1 : 0;
    }
  }
  const double middle_m = 0.5 * (at.low_m + at.high_m);
  if (!(at.high_m - at.low_m < kFlat * rms_about(h_m, middle_m))) return out;
  for (const double h : h_m) out.mean_m += (h - middle_m) / static_cast<double>(h_m.size());
  out.sigma_m = kEither * std::abs(out.mean_m);
  return out;
}

}  // namespace asperity::registration
