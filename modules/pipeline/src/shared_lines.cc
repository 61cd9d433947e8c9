#include "shared_lines.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "path_runs.h"
#include "run_links.h"

namespace asperity {

namespace {

constexpr std::size_t kSample = 64;  // runs in a cell that each run is compared with
constexpr int kRounds = 8;

// What each run that is not taken shares with others in sum, the most first.
class Shares {
 public:
  Shares(const std::vector<char>& taken, RunLinker& linker, const NearNodes& near)
      : sums_(taken.size(), 0), from_(taken.size()) {
    for (std::size_t r = 0; r < taken.size(); ++r) {
      if (taken[r] != 0) continue;
      for (const RunLink& link : linker.links_of(r, near)) {
        sums_[r] += link.last - link.first;
        from_[link.other].emplace_back(r, link.last - link.first);
      }
      if (sums_[r] > 0) order_.emplace(-static_cast<std::ptrdiff_t>(sums_[r]), r);
    }
  }
  [[nodiscard]] bool is_empty() const { return order_.empty(); }
  // Of equal ones the first.
  [[nodiscard]] std::size_t most() const { return order_.begin()->second; }
  void leave(std::size_t run) { set(run, 0); }
  void take(std::size_t run) {
    set(run, 0);
    for (const auto& [r, length] : from_[run]) {
      if (sums_[r] > 0) set(r, sums_[r] - length);
    }
  }

 private:
  void set(std::size_t run, std::size_t sum) {
    order_.erase({-static_cast<std::ptrdiff_t>(sums_[run]), run});
    sums_[run] = sum;
    if (sum > 0) order_.emplace(-static_cast<std::ptrdiff_t>(sum), run);
  }
  std::vector<std::size_t> sums_;
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> from_;  // runs that share with this one, how much
  std::set<std::pair<std::ptrdiff_t, std::size_t>> order_;
};

}  // namespace

std::vector<SharedLine> find_shared_lines(std::span<const std::vector<Eigen::Vector3d>> paths, double spacing_m,
                                          std::size_t* comparisons) {
  const auto step = static_cast<std::size_t>(std::max(1L, std::lround(kNode_m / spacing_m)));
  std::vector<std::vector<Node>> nodes;
  std::vector<Run> runs;
  for (std::size_t scan = 0; scan < paths.size(); ++scan) {
    nodes.push_back(make_nodes(paths[scan], step));
    add_runs(nodes.back(), scan, runs);
  }
  RunLinker linker(nodes, runs);
  std::vector<SharedLine> out;
  std::vector<char> taken(runs.size(), 0);
  bool is_sampled = true;
  for (int round = 0; round < kRounds && is_sampled; ++round) {
    NearNodes near;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      if (taken[r] != 0) continue;
      for (std::size_t i = runs[r].first; i < runs[r].last; ++i) near.add(nodes[runs[r].scan][i].p_m, {r, i});
    }
    NearNodes sample = near;
    is_sampled = sample.thin(kSample);
    Shares shares(taken, linker, sample);
    if (shares.is_empty()) break;
    while (!shares.is_empty()) {
      const std::size_t reference = shares.most();
      std::vector<RunLink> links = linker.links_of(reference, near);
      std::erase_if(links, [&](const RunLink& link) { return taken[link.other] != 0; });
      if (links.empty()) {  // what it shared was with the sample alone
        shares.leave(reference);
        continue;
      }
      shares.take(reference);
      SharedLine line;
      const auto add = [&](std::size_t run, std::size_t first, std::size_t last, double start_m, bool backward) {
        const std::size_t points = paths[runs[run].scan].size();
        line.push_back({runs[run].scan, first * step, std::min(last * step + 1, points), {start_m, backward, 1.5e-3}});
        taken[run] = 1;
      };
      std::size_t first = runs[reference].last, last = 0;
      for (const RunLink& link : links) {
        first = std::min(first, link.first);
        last = std::max(last, link.last);
      }
      const double origin_m = kNode_m * static_cast<double>(first);
      add(reference, first, last, 0.0, false);
      for (const RunLink& link : links) {
        add(link.other, link.other_first, link.other_last, link.start_m - origin_m, link.backward);
        shares.take(link.other);
      }
      out.push_back(std::move(line));
    }
  }
  if (comparisons != nullptr) *comparisons = linker.comparisons();
  return out;
}

}  // namespace asperity
