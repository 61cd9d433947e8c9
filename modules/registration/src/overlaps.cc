#include "overlaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>

namespace asperity::registration {

namespace {

constexpr double kWindow_m = 10e-3;      // of a stroke, whose texture is looked for in another
constexpr double kMostShift_m = 1e-3;    // along the path, between what the fit has and what the textures show
constexpr double kLeastAlike = 0.7;      // correlation of two windows that show the same texture
constexpr double kUnlike = 0.9;          // of another maximum to the highest, above which neither counts
constexpr double kCrossing_m = 3e-3;     // a shorter meeting is a crossing
constexpr double kApart_m = 5e-3;        // along one path, from which it meets itself
constexpr double kShiftFloor_m = 20e-6;  // of a shift: strokes beside each other see the texture a little differently

// Points of all paths by cells of space.
class Cells {
 public:
  Cells(const FacetHeights& heights, double size_m) : size_m_(size_m) {
    for (std::size_t i = 0; i < heights.d_m.size(); ++i) {
      if (heights.usable[i] != 0) points_[key(heights.p_mesh_m[i])].push_back(i);
    }
  }
  template <class Visit>
  void near(const Eigen::Vector3d& p_m, Visit visit) const {
    const std::array<long, 3> centre = key(p_m);
    for (long x = -1; x <= 1; ++x)
      for (long y = -1; y <= 1; ++y)
        for (long z = -1; z <= 1; ++z) {
          const auto found = points_.find({centre[0] + x, centre[1] + y, centre[2] + z});
          if (found == points_.end()) continue;
          for (const std::size_t i : found->second) visit(i);
        }
  }

 private:
  std::array<long, 3> key(const Eigen::Vector3d& p_m) const {
    return {std::lround(p_m.x() / size_m_), std::lround(p_m.y() / size_m_), std::lround(p_m.z() / size_m_)};
  }
  double size_m_;
  std::map<std::array<long, 3>, std::vector<std::size_t>> points_;
};

// A point of one path and the nearest of another, across b's path within reach.
struct Meeting {
  std::size_t a = 0, b = 0;
  double distance_m = 0.0;
};

bool follows(const PathChain& chain, const FacetHeights& heights, std::size_t i) {
  return i < heights.d_m.size() && chain.begins[i] == 0 && heights.usable[i] != 0 && heights.usable[i - 1] != 0;
}

// The height of a path between its points; nan where it is broken.
double height_at(const PathChain& chain, const FacetHeights& heights, std::size_t b, double offset) {
  const double at = static_cast<double>(b) + offset;
  const double low = std::floor(at);
  if (!(low >= 0.0)) return std::numeric_limits<double>::quiet_NaN();
  const auto i = static_cast<std::size_t>(low);
  if (i + 1 >= heights.d_m.size() || !follows(chain, heights, i + 1) || chain.part_of[i] != chain.part_of[b])
    return std::numeric_limits<double>::quiet_NaN();
  const double share = at - low;
  return (1.0 - share) * heights.d_m[i] + share * heights.d_m[i + 1];
}

struct TextureMatch {
  double shift = 0.0;  // in points of b
  double correlation = 0.0;
  double sigma = std::numeric_limits<double>::infinity();  // of the shift
};

// Where along b the heights of a's window are found again. `offset[k]` is where b is beside point k of the window.
TextureMatch match_window(const PathChain& chain, const FacetHeights& heights, std::span<const Meeting> window,
                          std::span<const double> offset, double spacing_m) {
  constexpr double kStep = 0.25;
  const double most = kMostShift_m / spacing_m;
  const auto correlation_at = [&](double shift, double* slope2, double* noise2) {
    double n = 0.0, sa = 0.0, sb = 0.0, saa = 0.0, sbb = 0.0, sab = 0.0, slopes = 0.0;
    for (std::size_t k = 0; k < window.size(); ++k) {
      const double a = heights.d_m[window[k].a];
      const double b = height_at(chain, heights, window[k].b, offset[k] + shift);
      const double after = height_at(chain, heights, window[k].b, offset[k] + shift + 0.5);
      const double before = height_at(chain, heights, window[k].b, offset[k] + shift - 0.5);
      if (!std::isfinite(b) || !std::isfinite(after) || !std::isfinite(before)) continue;
      n += 1.0, sa += a, sb += b, saa += a * a, sbb += b * b, sab += a * b;
      slopes += (after - before) * (after - before);
    }
    if (n < 0.8 * static_cast<double>(window.size())) return -1.0;
    const double vaa = saa - sa * sa / n, vbb = sbb - sb * sb / n, vab = sab - sa * sb / n;
    if (!(vaa > 0.0) || !(vbb > 0.0)) return -1.0;
    if (slope2 != nullptr) *slope2 = slopes * (vab / vbb) * (vab / vbb);
    if (noise2 != nullptr) *noise2 = (vaa - vab * vab / vbb) / n;
    return vab / std::sqrt(vaa * vbb);
  };
  TextureMatch out;
  out.correlation = -1.0;
  std::vector<std::array<double, 2>> tried;  // shift, correlation
  for (double shift = -most; shift <= most + 1e-9; shift += kStep) {
    const double r = correlation_at(shift, nullptr, nullptr);
    tried.push_back({shift, r});
    if (r > out.correlation) out = {shift, r, out.sigma};
  }
  // A texture that repeats within the range says no more than which of its periods it may be.
  for (std::size_t k = 1; k + 1 < tried.size(); ++k) {
    const bool top = tried[k][1] >= tried[k - 1][1] && tried[k][1] >= tried[k + 1][1];
    if (top && std::abs(tried[k][0] - out.shift) > 2.0 * kStep && tried[k][1] > kUnlike * out.correlation) return {};
  }
  // At the end of the search the top may be beyond.
  if (!(out.correlation >= kLeastAlike) || std::abs(out.shift) > most - 2.0 * kStep) return {};
  const double before = correlation_at(out.shift - kStep, nullptr, nullptr);
  const double after = correlation_at(out.shift + kStep, nullptr, nullptr);
  const double bend = before - 2.0 * out.correlation + after;
  if (bend < 0.0) out.shift += std::clamp(0.5 * kStep * (before - after) / bend, -kStep, kStep);
  double slope2 = 0.0, noise2 = 0.0;
  out.correlation = correlation_at(out.shift, &slope2, &noise2);
  if (!(out.correlation >= kLeastAlike) || !(slope2 > 0.0)) return {};
  out.sigma = 1.5 * std::sqrt(noise2 / slope2);  // neighbouring points share some of their noise
  return out;
}

// Where b's path passes point a: b and how far past it, in points.
double offset_along(const PathChain& chain, const FacetHeights& heights, const Meeting& at) {
  const std::size_t before = follows(chain, heights, at.b) ? at.b - 1 : at.b;
  const std::size_t after = follows(chain, heights, at.b + 1) ? at.b + 1 : at.b;
  if (before == after) return 0.0;
  const Eigen::Vector3d step_m =
      (heights.p_mesh_m[after] - heights.p_mesh_m[before]) / static_cast<double>(after - before);
  const double square_m2 = step_m.squaredNorm();
  if (!(square_m2 > 0.0)) return 0.0;
  return std::clamp((heights.p_mesh_m[at.a] - heights.p_mesh_m[at.b]).dot(step_m) / square_m2, -1.0, 1.0);
}

// A path's direction is that over some millimetres: its relief turns shorter steps.
constexpr double kDirection_m = 2e-3;

OverlapLink make_link(const PathChain& chain, const FacetHeights& heights, std::size_t a, double at, bool along,
                      double sigma_m) {
  const double low = std::floor(at);
  OverlapLink out{a, static_cast<std::size_t>(low), at - low, along, sigma_m, 0, 0};
  out.from = out.b;
  out.to = out.b;
  const auto reach = static_cast<std::size_t>(std::ceil(kDirection_m / chain.spacing_m));
  for (std::size_t k = 0; k < reach && follows(chain, heights, out.from); ++k) --out.from;
  for (std::size_t k = 0; k <= reach && follows(chain, heights, out.to + 1); ++k) ++out.to;
  return out;
}

void link_run(const PathChain& chain, const FacetHeights& heights, std::span<const Meeting> run,
              std::vector<OverlapLink>& out) {
  const auto length_m = static_cast<double>(run.size()) * chain.spacing_m;
  const std::size_t pa = chain.part_of[run.front().a], pb = chain.part_of[run.front().b];
  const auto add = [&](const Meeting& at, double offset, bool along, double sigma_m) {
    const double place = static_cast<double>(at.b) + offset;
    if (!(place >= 0.0)) return;
    const OverlapLink link = make_link(chain, heights, at.a, place, along, sigma_m);
    if (chain.part_of[link.b] == pb && follows(chain, heights, link.b + 1)) out.push_back(link);
  };
  if (length_m < kCrossing_m) {
    const Meeting& nearest = *std::min_element(
        run.begin(), run.end(), [](const Meeting& x, const Meeting& y) { return x.distance_m < y.distance_m; });
    // Across, each path is known no better than its texture is fine: the heights may differ by all of it.
    const double sigma_m = std::hypot(heights.part_rms_m[pa], heights.part_rms_m[pb]);
    if (sigma_m > 0.0) add(nearest, offset_along(chain, heights, nearest), false, sigma_m);
    return;
  }
  const auto size = static_cast<std::size_t>(std::max(8.0, std::round(kWindow_m / chain.spacing_m)));
  for (std::size_t first = 0; first + size <= run.size(); first += size) {
    const auto window = run.subspan(first, size);
    std::vector<double> offset;
    for (const Meeting& at : window) offset.push_back(offset_along(chain, heights, at));
    const TextureMatch match = match_window(chain, heights, window, offset, chain.spacing_m);
    if (!std::isfinite(match.sigma)) continue;
    add(window[size / 2], offset[size / 2] + match.shift, true,
        std::hypot(kShiftFloor_m, match.sigma * chain.spacing_m));
  }
}

}  // namespace

LinkResidual link_residual(const OverlapLink& link, const FacetHeights& heights) {
  LinkResidual out;
  for (const std::size_t i : {link.a, link.b, link.b + 1, link.from, link.to}) {
    if (heights.usable[i] == 0) return out;
  }
  const Eigen::Vector3d step_m = heights.p_mesh_m[link.b + 1] - heights.p_mesh_m[link.b];
  out.direction = heights.normal[link.a];
  if (link.along) {
    const Eigen::Vector3d along_m = heights.p_mesh_m[link.to] - heights.p_mesh_m[link.from];
    out.direction = (along_m - out.direction.dot(along_m) * out.direction).normalized();
  }
  out.value_m = out.direction.dot(heights.p_mesh_m[link.a] - heights.p_mesh_m[link.b] - link.share * step_m);
  out.known = std::isfinite(out.value_m) && out.direction.squaredNorm() > 0.5;
  return out;
}

std::vector<OverlapLink> find_overlaps(const PathChain& chain, const FacetHeights& heights, double reach_m) {
  std::vector<OverlapLink> out;
  if (!(chain.spacing_m > 0.0) || !(reach_m > 0.0)) return out;
  const double search_m = std::hypot(reach_m, chain.spacing_m);
  const Cells cells(heights, search_m);
  const auto apart = static_cast<std::size_t>(std::ceil(kApart_m / chain.spacing_m));
  // For each point the nearest of each other path, and of its own path farther on.
  std::map<std::array<std::size_t, 2>, std::vector<Meeting>> meetings;
  for (std::size_t a = 0; a < heights.d_m.size(); ++a) {
    if (heights.usable[a] == 0) continue;
    std::map<std::size_t, Meeting> nearest;  // by b's path
    cells.near(heights.p_mesh_m[a], [&](std::size_t b) {
      const std::size_t pa = chain.part_of[a], pb = chain.part_of[b];
      if (pb < pa || (pa == pb && b < a + apart)) return;
      const double distance_m = (heights.p_mesh_m[a] - heights.p_mesh_m[b]).norm();
      if (distance_m > search_m || heights.normal[a].dot(heights.normal[b]) < 0.7) return;
      const auto [at, is_new] = nearest.try_emplace(pb, Meeting{a, b, distance_m});
      if (!is_new && distance_m < at->second.distance_m) at->second = {a, b, distance_m};
    });
    for (const auto& [pb, meeting] : nearest) meetings[{chain.part_of[a], pb}].push_back(meeting);
  }
  // Unbroken runs along both.
  for (const auto& [pair, list] : meetings) {
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= list.size(); ++i) {
      const bool broken = i == list.size() || list[i].a > list[i - 1].a + 4 ||
                          (list[i].b > list[i - 1].b ? list[i].b - list[i - 1].b : list[i - 1].b - list[i].b) > 8;
      if (!broken) continue;
      link_run(chain, heights, {list.data() + begin, i - begin}, out);
      begin = i;
    }
  }
  return out;
}

}  // namespace asperity::registration
