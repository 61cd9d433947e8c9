#include "run_links.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kNear_m = 0.6e-3;        // further apart, no two lines of a fine relief are alike
constexpr double kParallel_cosine = 0.9;  // 26°
constexpr double kHole_m = 2e-3;          // on which two paths may part

// Runs in an order that has nothing to do with their numbers, so that the first ones are a fair sample.
std::uint64_t rank(std::size_t run) {
  std::uint64_t x = static_cast<std::uint64_t>(run) + 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

}  // namespace

NearNodes::Cell NearNodes::cell_of(const Eigen::Vector3d& p_m) {
  Cell out{};
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<std::int64_t>(std::floor(p_m[static_cast<Eigen::Index>(k)] / kNear_m));
  return out;
}

// Cells that share a key cost time alone: the distance decides.
std::uint64_t NearNodes::key(const Cell& cell) {
  std::uint64_t out = 0;
  for (const std::int64_t value : cell) out = out * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(value);
  return out;
}

void NearNodes::add(const Eigen::Vector3d& p_m, Entry entry) {
  Content& cell = cells_[key(cell_of(p_m))];
  if (cell.entries.empty() || cell.entries.back().run != entry.run)
    cell.visits = 1;
  else if (entry.node != cell.last_node + 1)
    ++cell.visits;
  cell.last_node = entry.node;
  if (cell.visits <= kVisits) cell.entries.push_back(entry);
}

bool NearNodes::thin(std::size_t most) {
  bool any = false;
  for (auto& [key, cell] : cells_) {
    std::vector<std::uint64_t> ranks;
    for (std::size_t i = 0; i < cell.entries.size(); ++i) {
      if (i == 0 || cell.entries[i].run != cell.entries[i - 1].run) ranks.push_back(rank(cell.entries[i].run));
    }
    if (ranks.size() <= most) continue;
    any = true;
    const auto end = ranks.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(ranks.begin(), end, ranks.end());
    std::erase_if(cell.entries, [&](const Entry& entry) { return rank(entry.run) >= *end; });
  }
  return any;
}

RunLinker::RunLinker(std::span<const std::vector<Node>> nodes, std::span<const Run> runs)
    : nodes_(nodes), runs_(runs), others_(runs.size()) {}

// The longest stretch of matches in one direction, by rising nodes; false: it is too short.
bool RunLinker::longest_link(const std::vector<Match>& matches, RunLink& out) {
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
  if (best_end == 0 || matches[best_end - 1].node - matches[best].node < nodes_in(kShortestLine_m)) return false;
  out.first = matches[best].node;
  out.last = matches[best_end - 1].node;
  out.other_first = out.other_last = matches[best].other;
  out.backward = matches[best].backward;
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
  return true;
}

std::vector<RunLink> RunLinker::links_of(std::size_t run, const NearNodes& near) {
  std::vector<std::size_t> seen, at_node;
  const std::vector<Node>& nodes = nodes_[runs_[run].scan];
  for (std::size_t i = runs_[run].first; i < runs_[run].last; ++i) {
    const Node& node = nodes[i];
    at_node.clear();
    near.visit(node.p_m, [&](const NearNodes::Entry& entry) {
      ++comparisons_;
      if (entry.run == run) return;
      const Node& candidate = nodes_[runs_[entry.run].scan][entry.node];
      const double cosine = node.direction.dot(candidate.direction), apart_m = (node.p_m - candidate.p_m).norm();
      if (std::abs(cosine) < kParallel_cosine || apart_m > kNear_m) return;
      Other& other = others_[entry.run];
      if (other.at == 0)
        at_node.push_back(entry.run);
      else if (other.apart_m <= apart_m)
        return;
      other.apart_m = apart_m;
      other.at = entry.node + 1;
    });
    for (const std::size_t r : at_node) {
      Other& other = others_[r];
      const std::size_t at = std::exchange(other.at, 0) - 1;
      if (other.matches.empty()) seen.push_back(r);
      other.matches.push_back({i, at, node.direction.dot(nodes_[runs_[r].scan][at].direction) < 0.0});
    }
  }
  std::sort(seen.begin(), seen.end());
  std::vector<RunLink> out;
  for (const std::size_t r : seen) {
    RunLink link;
    link.other = r;
    if (longest_link(others_[r].matches, link)) out.push_back(link);
    others_[r].matches = {};
  }
  return out;
}

}  // namespace asperity
