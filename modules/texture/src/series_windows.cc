#include "series_windows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/signal/zero_phase.h"

namespace asperity {
namespace {

struct Point {
  double u = 0.0;
  double v = 0.0;
};

double distance2(const Point& a, const Point& b) { return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v); }

int nearest(const std::vector<Point>& centres, const Point& p) {
  int best = 0;
  for (std::size_t i = 1; i < centres.size(); ++i) {
    if (distance2(centres[i], p) < distance2(centres[static_cast<std::size_t>(best)], p)) best = static_cast<int>(i);
  }
  return best;
}

// The first centre is the point nearest to the mean, each next one the point farthest from those before.
std::vector<Point> farthest_points(const std::vector<Point>& points, std::size_t count) {
  Point mean;
  for (const auto& p : points) {
    mean.u += p.u / static_cast<double>(points.size());
    mean.v += p.v / static_cast<double>(points.size());
  }
  std::vector<Point> centres{points[static_cast<std::size_t>(nearest(points, mean))]};
  while (centres.size() < count) {
    double farthest = 0.0;
    Point best;
    for (const auto& p : points) {
      const double d = distance2(centres[static_cast<std::size_t>(nearest(centres, p))], p);
      if (d > farthest) {
        farthest = d;
        best = p;
      }
    }
    if (farthest == 0.0) break;
    centres.push_back(best);
  }
  return centres;
}

}  // namespace

void check_recording(const SeriesRecording& r) {
  const std::size_t count = r.acceleration_mps2.size();
  if (r.speed_mps.size() != count || r.force_N.size() != count) {
    throw Error("texture: " + std::to_string(count) + " accelerations, " + std::to_string(r.speed_mps.size()) +
                " speeds and " + std::to_string(r.force_N.size()) + " forces; as many of each are needed");
  }
  if (!(r.rate_Hz >= 1.0 && r.rate_Hz <= 1e6))
    throw Error("texture: the rate " + number_text(r.rate_Hz) + " Hz is not within 1 and 1e6");
  constexpr double kMost_mps2 = 1e6, kFastest_mps = 1e3, kMost_N = 1e6;  // beyond every sensor
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(r.acceleration_mps2[i]) || !std::isfinite(r.speed_mps[i]) || !std::isfinite(r.force_N[i]))
      throw Error("texture: sample " + std::to_string(i + 1) + " of the recording is not finite");
    if (std::abs(r.acceleration_mps2[i]) > kMost_mps2 || std::abs(r.speed_mps[i]) > kFastest_mps ||
        std::abs(r.force_N[i]) > kMost_N) {
      throw Error("texture: sample " + std::to_string(i + 1) +
                  " of the recording is not plausible: " + number_text(r.acceleration_mps2[i]) + " m/s², " +
                  number_text(r.speed_mps[i]) + " m/s, " + number_text(r.force_N[i]) + " N");
    }
  }
}

std::vector<double> vibration_mps2(const SeriesRecording& r, const FitAutoregressiveConfig& config) {
  if (config.high_pass_Hz > 0.0 && config.high_pass_Hz < 0.5 * r.rate_Hz && r.acceleration_mps2.size() > 8)
    return zero_phase_highpass(r.acceleration_mps2, config.high_pass_Hz, r.rate_Hz);
  return {r.acceleration_mps2.begin(), r.acceleration_mps2.end()};
}

std::vector<SeriesWindow> stroking_windows(const SeriesRecording& r, const FitAutoregressiveConfig& config) {
  const auto length = static_cast<std::size_t>(std::max(8.0, std::round(config.window_s * r.rate_Hz)));
  std::vector<SeriesWindow> windows;
  for (std::size_t first = 0; first + length <= r.acceleration_mps2.size(); first += length) {
    SeriesWindow w{first, length, 0.0, 0.0};
    for (std::size_t i = first; i < first + length; ++i) {
      w.speed_mps += r.speed_mps[i] / static_cast<double>(length);
      w.force_N += r.force_N[i] / static_cast<double>(length);
    }
    if (w.speed_mps >= config.min_speed_mps && w.force_N >= config.min_force_N) windows.push_back(w);
  }
  return windows;
}

std::vector<int> group_windows(const std::vector<SeriesWindow>& windows, int groups, std::size_t least) {
  double max_speed = 0.0;
  double max_force = 0.0;
  for (const auto& w : windows) {
    max_speed = std::max(max_speed, w.speed_mps);
    max_force = std::max(max_force, w.force_N);
  }
  std::vector<Point> points;
  for (const auto& w : windows)
    points.push_back({max_speed > 0.0 ? w.speed_mps / max_speed : 0.0, max_force > 0.0 ? w.force_N / max_force : 0.0});
  auto centres = farthest_points(points, static_cast<std::size_t>(std::max(groups, 1)));
  std::vector<int> group(points.size());
  constexpr int kMostRounds = 200;
  for (int round = 0; round < kMostRounds; ++round) {
    bool changed = round == 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int g = nearest(centres, points[i]);
      changed = changed || g != group[i];
      group[i] = g;
    }
    std::vector<Point> sum(centres.size());
    std::vector<std::size_t> count(centres.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto g = static_cast<std::size_t>(group[i]);
      sum[g].u += points[i].u;
      sum[g].v += points[i].v;
      ++count[g];
    }
    if (!changed) {
      const auto smallest = static_cast<std::size_t>(std::min_element(count.begin(), count.end()) - count.begin());
      if (centres.size() == 1 || count[smallest] >= least) break;
      centres.erase(centres.begin() + static_cast<std::ptrdiff_t>(smallest));
      continue;
    }
    for (std::size_t g = 0; g < centres.size(); ++g) {
      const double n = static_cast<double>(count[g]);
      if (count[g] > 0) centres[g] = {sum[g].u / n, sum[g].v / n};
    }
  }
  // Numbered in the order in which they come.
  std::vector<int> number(centres.size(), -1);
  int next = 0;
  for (int& g : group) {
    int& n = number[static_cast<std::size_t>(g)];
    if (n < 0) n = next++;
    g = n;
  }
  return group;
}

}  // namespace asperity
