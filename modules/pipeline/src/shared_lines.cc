#include "shared_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kNode_m = 0.25e-3;       // between the points that are compared
constexpr double kNear_m = 0.6e-3;        // further apart, no two lines of a fine relief are alike
constexpr double kDirection_m = 1e-3;     // over which a direction is measured
constexpr double kTurn_m = 3e-3;          // over which a turn is
constexpr double kTurn_cosine = 0.34;     // 70°
constexpr double kParallel_cosine = 0.9;  // 26°
constexpr double kShortestLine_m = 15e-3;
constexpr double kHole_m = 2e-3;  // on which two paths may part

struct Node {
  Eigen::Vector3d p_m, direction;
  bool is_known = false;
};

// A part of a scan's path without turns; nodes of the scan.
struct Run {
  std::size_t scan = 0, first = 0, last = 0;
};

std::size_t nodes_in(double length_m) { return static_cast<std::size_t>(std::lround(length_m / kNode_m)); }

std::vector<Node> make_nodes(const std::vector<Eigen::Vector3d>& path, std::size_t step) {
  std::vector<Node> out;
  for (std::size_t i = 0; i < path.size(); i += step) out.push_back({path[i], Eigen::Vector3d::Zero(), false});
  const std::size_t reach = nodes_in(0.5 * kDirection_m);
  for (std::size_t i = reach; i + reach < out.size(); ++i) {
    const Eigen::Vector3d way_m = out[i + reach].p_m - out[i - reach].p_m;
    if (!out[i].p_m.allFinite() || !way_m.allFinite() || !(way_m.norm() > 0.0)) continue;
    out[i].direction = way_m.normalized();
    out[i].is_known = true;
  }
  return out;
}

// The parts of a path between its turns that are long enough.
void add_runs(const std::vector<Node>& nodes, std::size_t scan, std::vector<Run>& out) {
  const std::size_t reach = nodes_in(0.5 * kTurn_m);
  const auto goes_on = [&](std::size_t i) {
    if (!nodes[i].is_known) return false;
    const std::size_t before = i < reach ? 0 : i - reach, after = std::min(i + reach, nodes.size() - 1);
    if (!nodes[before].is_known || !nodes[after].is_known) return true;  // beside an end
    return nodes[before].direction.dot(nodes[after].direction) > kTurn_cosine;
  };
  for (std::size_t begin = 0; begin < nodes.size();) {
    std::size_t end = begin;
    while (end < nodes.size() && goes_on(end)) ++end;
    if (end - begin > nodes_in(kShortestLine_m)) out.push_back({scan, begin, end});
    begin = end + 1;
  }
}

// Nodes by cells as wide as lines may be apart.
class NearNodes {
 public:
  struct Entry {
    std::size_t run, node;
  };
  void add(const Eigen::Vector3d& p_m, Entry entry) { cells_[key(cell_of(p_m))].push_back(entry); }
  template <class Visit>
  void visit(const Eigen::Vector3d& p_m, Visit visit) const {
    const std::array<std::int64_t, 3> at = cell_of(p_m);
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto found = cells_.find(key({at[0] + x, at[1] + y, at[2] + z}));
          if (found == cells_.end()) continue;
          for (const Entry& entry : found->second) visit(entry);
        }
      }
    }
  }

 private:
  static std::array<std::int64_t, 3> cell_of(const Eigen::Vector3d& p_m) {
    std::array<std::int64_t, 3> out{};
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = static_cast<std::int64_t>(std::floor(p_m[static_cast<Eigen::Index>(k)] / kNear_m));
    return out;
  }
  // Cells that share a key cost time alone: the distance decides.
  static std::uint64_t key(const std::array<std::int64_t, 3>& cell) {
    std::uint64_t out = 0;
    for (const std::int64_t value : cell) out = out * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(value);
    return out;
  }
  std::unordered_map<std::uint64_t, std::vector<Entry>> cells_;
};

struct Match {
  std::size_t node, other;
  bool backward;
};

// What one run shares with another.
struct Link {
  std::size_t first = 0, last = 0;              // nodes of the run, `last` among them
  std::size_t other_first = 0, other_last = 0;  // of the other
  bool backward = false;
  double start_m = 0.0;  // of the other's first node, along the run's nodes from the scan's first
};

// The longest stretch of matches in one direction, by rising nodes.
std::optional<Link> longest_link(const std::vector<Match>& matches) {
  std::size_t best = 0, best_end = 0;
  for (std::size_t begin = 0; begin < matches.size();) {
    std::size_t end = begin + 1;
    while (end < matches.size() && matches[end].backward == matches[begin].backward &&
           matches[end].node - matches[end - 1].node <= nodes_in(kHole_m))
      ++end;
    if (best_end == 0 ||
        matches[end - 1].node - matches[begin].node > matches[best_end - 1].node - matches[best].node) {
      best = begin;
      best_end = end;
    }
    begin = end;
  }
  if (best_end == 0 || matches[best_end - 1].node - matches[best].node < nodes_in(kShortestLine_m)) return std::nullopt;
  Link out{matches[best].node,  matches[best_end - 1].node, matches[best].other,
           matches[best].other, matches[best].backward,     0.0};
  for (std::size_t i = best; i < best_end; ++i) {
    out.other_first = std::min(out.other_first, matches[i].other);
    out.other_last = std::max(out.other_last, matches[i].other);
  }
  std::vector<double> starts;
  for (std::size_t i = best; i < best_end; ++i) {
    const double way = static_cast<double>(matches[i].other - out.other_first);
    starts.push_back(kNode_m * (static_cast<double>(matches[i].node) + (out.backward ? way : -way)));
  }
  out.start_m = median(starts);
  return out;
}

using Links = std::map<std::size_t, Link>;  // by the other run

std::vector<Links> link_runs(const std::vector<std::vector<Node>>& nodes, const std::vector<Run>& runs) {
  NearNodes near;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (std::size_t i = runs[r].first; i < runs[r].last; ++i) near.add(nodes[runs[r].scan][i].p_m, {r, i});
  }
  std::vector<Links> out(runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    std::map<std::size_t, std::vector<Match>> matches;
    for (std::size_t i = runs[r].first; i < runs[r].last; ++i) {
      const Node& node = nodes[runs[r].scan][i];
      std::map<std::size_t, std::pair<double, Match>> nearest;
      near.visit(node.p_m, [&](const NearNodes::Entry& entry) {
        if (entry.run == r) return;
        const Node& other = nodes[runs[entry.run].scan][entry.node];
        const double cosine = node.direction.dot(other.direction), apart_m = (node.p_m - other.p_m).norm();
        if (std::abs(cosine) < kParallel_cosine || apart_m > kNear_m) return;
        const auto found = nearest.find(entry.run);
        if (found != nearest.end() && found->second.first <= apart_m) return;
        nearest[entry.run] = {apart_m, {i, entry.node, cosine < 0.0}};
      });
      for (const auto& [run, match] : nearest) matches[run].push_back(match.second);
    }
    for (const auto& [run, all] : matches) {
      if (const std::optional<Link> link = longest_link(all)) out[r].emplace(run, *link);
    }
  }
  return out;
}

}  // namespace

std::vector<SharedLine> find_shared_lines(std::span<const std::vector<Eigen::Vector3d>> paths, double spacing_m) {
  const auto step = static_cast<std::size_t>(std::max(1L, std::lround(kNode_m / spacing_m)));
  std::vector<std::vector<Node>> nodes;
  std::vector<Run> runs;
  for (std::size_t scan = 0; scan < paths.size(); ++scan) {
    nodes.push_back(make_nodes(paths[scan], step));
    add_runs(nodes.back(), scan, runs);
  }
  const std::vector<Links> links = link_runs(nodes, runs);

  std::vector<SharedLine> out;
  std::vector<char> taken(runs.size(), 0);
  while (true) {
    std::size_t reference = runs.size(), most = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      std::size_t shared = 0;
      for (const auto& [other, link] : links[r])
        shared += taken[r] == 0 && taken[other] == 0 ? link.last - link.first : 0;
      if (shared <= most) continue;
      most = shared;
      reference = r;
    }
    if (reference == runs.size()) return out;
    SharedLine line;
    const auto add = [&](std::size_t run, std::size_t first, std::size_t last, double start_m, bool backward) {
      const std::size_t points = paths[runs[run].scan].size();
      line.push_back({runs[run].scan, first * step, std::min(last * step + 1, points), {start_m, backward, 1.5e-3}});
      taken[run] = 1;
    };
    std::size_t first = runs[reference].last, last = 0;
    for (const auto& [other, link] : links[reference]) {
      if (taken[other] != 0) continue;
      first = std::min(first, link.first);
      last = std::max(last, link.last);
    }
    const double origin_m = kNode_m * static_cast<double>(first);
    add(reference, first, last, 0.0, false);
    for (const auto& [other, link] : links[reference]) {
      if (taken[other] == 0) add(other, link.other_first, link.other_last, link.start_m - origin_m, link.backward);
    }
    out.push_back(std::move(line));
  }
}

}  // namespace asperity
