#include "asperity/texture/triangulate_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "asperity/base/error.h"

namespace asperity {
namespace {

__extension__ using Wide = __int128;
using Triangle = std::array<int, 3>;

struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  int index = 0;  // of the point it came from
};

// Positive where c lies left of the line from a to b. |values| < 2⁴³ for coordinates within 2²⁰.
std::int64_t left_of(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Whether d lies inside the circle through a, b, c, counter-clockwise. Terms stay below 2⁸⁷.
bool in_circle(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const auto row = [&](const GridPoint& p) {
    const std::int64_t x = p.x - d.x;
    const std::int64_t y = p.y - d.y;
    return std::array<Wide, 3>{x, y, Wide(x) * x + Wide(y) * y};
  };
  const auto u = row(a);
  const auto v = row(b);
  const auto w = row(c);
  return u[0] * (v[1] * w[2] - w[1] * v[2]) - u[1] * (v[0] * w[2] - w[0] * v[2]) + u[2] * (v[0] * w[1] - w[0] * v[1]) >
         0;
}

std::vector<GridPoint> sorted_grid(std::span<const PlanePoint> points) {
  if (points.size() > 4096) throw Error("triangulation: " + std::to_string(points.size()) + " points, more than 4096");
  PlanePoint low{}, high{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t d = 0; d < 2; ++d) {
      const double x = points[i][d];
      if (!std::isfinite(x)) throw Error("triangulation: point " + std::to_string(i + 1) + " is not finite");
      low[d] = i == 0 ? x : std::min(low[d], x);
      high[d] = i == 0 ? x : std::max(high[d], x);
    }
  }
  const double extent = std::max(high[0] - low[0], high[1] - low[1]);
  const double scale = extent > 0.0 ? 0x1p20 / extent : 0.0;
  std::vector<GridPoint> grid;
  for (std::size_t i = 0; i < points.size(); ++i) {
    grid.push_back({std::llround((points[i][0] - low[0]) * scale), std::llround((points[i][1] - low[1]) * scale),
                    static_cast<int>(i)});
  }
  std::sort(grid.begin(), grid.end(), [](const GridPoint& a, const GridPoint& b) {
    return std::array<std::int64_t, 3>{a.x, a.y, a.index} < std::array<std::int64_t, 3>{b.x, b.y, b.index};
  });
  grid.erase(std::unique(grid.begin(), grid.end(),
                         [](const GridPoint& a, const GridPoint& b) { return a.x == b.x && a.y == b.y; }),
             grid.end());
  return grid;
}

// Triangles by their directed edges.
struct Mesh {
  std::vector<Triangle> triangles;
  std::map<std::pair<int, int>, int> owner;

  void add(const Triangle& t) {
    triangles.push_back(t);
    own(static_cast<int>(triangles.size()) - 1);
  }
  void own(int i) {
    const auto& t = triangles[static_cast<std::size_t>(i)];
    for (std::size_t e = 0; e < 3; ++e) owner[{t[e], t[(e + 1) % 3]}] = i;
  }
};

int apex(const Triangle& t, int a, int b) {
  for (const int v : t) {
    if (v != a && v != b) return v;
  }
  return -1;
}

Mesh sweep_points(const std::vector<GridPoint>& p) {
  Mesh mesh;
  const int count = static_cast<int>(p.size());
  const auto at = [&](int i) -> const GridPoint& { return p[static_cast<std::size_t>(i)]; };
  int first = 2;
  while (first < count && left_of(at(0), at(first - 1), at(first)) == 0) ++first;
  if (first >= count) return mesh;
  // The points before `first` lie on a line: a fan, and the hull counter-clockwise.
  std::vector<int> hull;
  const bool left = left_of(at(0), at(first - 1), at(first)) > 0;
  for (int i = 0; i + 1 < first; ++i) mesh.add(left ? Triangle{i, i + 1, first} : Triangle{i + 1, i, first});
  for (int i = 0; i < first; ++i) hull.push_back(left ? i : first - 1 - i);
  hull.push_back(first);
  for (int i = first + 1; i < count; ++i) {
    const std::size_t n = hull.size();
    std::vector<bool> visible(n);
    for (std::size_t e = 0; e < n; ++e) visible[e] = left_of(at(hull[e]), at(hull[(e + 1) % n]), at(i)) < 0;
    std::size_t start = 0;  // the first hidden edge after the visible ones
    while (visible[start] || !visible[(start + n - 1) % n]) ++start;
    std::vector<int> next;
    std::size_t e = start;
    for (; !visible[e % n]; ++e) next.push_back(hull[e % n]);
    next.push_back(hull[e % n]);
    for (; visible[e % n] && e < start + n; ++e) mesh.add({hull[(e + 1) % n], hull[e % n], i});
    next.push_back(i);
    hull = std::move(next);
  }
  return mesh;
}

void flip_until_delaunay(Mesh& mesh, const std::vector<GridPoint>& p) {
  std::vector<std::pair<int, int>> open;
  for (const auto& [edge, triangle] : mesh.owner) {
    if (edge.first < edge.second) open.push_back(edge);
  }
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    const auto mine = mesh.owner.find({a, b});
    const auto other = mesh.owner.find({b, a});
    if (mine == mesh.owner.end() || other == mesh.owner.end()) continue;
    const int t = mine->second;
    const int u = other->second;
    const int c = apex(mesh.triangles[static_cast<std::size_t>(t)], a, b);
    const int d = apex(mesh.triangles[static_cast<std::size_t>(u)], a, b);
    const auto at = [&](int i) -> const GridPoint& { return p[static_cast<std::size_t>(i)]; };
    if (!in_circle(at(a), at(b), at(c), at(d))) continue;
    mesh.owner.erase(mine);
    mesh.owner.erase(other);
    mesh.triangles[static_cast<std::size_t>(t)] = {c, a, d};
    mesh.triangles[static_cast<std::size_t>(u)] = {d, b, c};
    mesh.own(t);
    mesh.own(u);
    for (const auto& edge : {std::pair{a, d}, std::pair{d, b}, std::pair{b, c}, std::pair{c, a}}) open.push_back(edge);
  }
}

}  // namespace

std::vector<std::array<int, 3>> triangulate_points(std::span<const PlanePoint> points) {
  const auto grid = sorted_grid(points);
  Mesh mesh = sweep_points(grid);
  flip_until_delaunay(mesh, grid);
  for (Triangle& t : mesh.triangles) {
    for (int& v : t) v = grid[static_cast<std::size_t>(v)].index;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(mesh.triangles.begin(), mesh.triangles.end());
  return mesh.triangles;
}

std::vector<std::array<int, 2>> border_edges(std::span<const PlanePoint> points,
                                             std::span<const std::array<int, 3>> triangles) {
  std::vector<std::array<int, 2>> edges;
  if (triangles.empty()) {
    const auto grid = sorted_grid(points);
    for (std::size_t i = 0; i + 1 < grid.size(); ++i) edges.push_back({grid[i].index, grid[i + 1].index});
    return edges;
  }
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : triangles) {
    for (std::size_t e = 0; e < 3; ++e) ++uses[std::minmax({t[e], t[(e + 1) % 3]})];
  }
  for (const auto& [edge, count] : uses) {
    if (count == 1) edges.push_back({edge.first, edge.second});
  }
  return edges;
}

}  // namespace asperity
