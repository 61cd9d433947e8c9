#include "path_runs.h"

#include <algorithm>

namespace asperity {

namespace {

constexpr double kDirection_m = 1e-3;  // over which a direction is measured
constexpr double kTurn_m = 3e-3;       // over which a turn is
constexpr double kTurn_cosine = 0.34;  // 70°

}  // namespace

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

}  // namespace asperity
