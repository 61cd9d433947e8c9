#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "path_runs.h"

namespace asperity {

// What one run shares with another.
struct RunLink {
  std::size_t other = 0;                        // the other run
  std::size_t first = 0, last = 0;              // nodes of the run, `last` among them
  std::size_t other_first = 0, other_last = 0;  // of the other
  bool backward = false;
  double start_m = 0.0;  // of the other's first node, along the run's nodes from the scan's first
};

// Nodes of runs by cells as wide as lines may be apart.
class NearNodes {
 public:
  struct Entry {
    std::size_t run, node;
  };
  // Runs in rising order, their nodes too. Of a run that comes through one cell again and again, the first
  // `kVisits` times are kept.
  void add(const Eigen::Vector3d& p_m, Entry entry);
  // With at most `most` runs in a cell: the same ones in neighbouring cells. True: a cell had more.
  bool thin(std::size_t most);
  template <class Visit>
  void visit(const Eigen::Vector3d& p_m, Visit visit) const {
    const Cell at = cell_of(p_m);
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto found = cells_.find(key({at[0] + x, at[1] + y, at[2] + z}));
          if (found == cells_.end()) continue;
          for (const Entry& entry : found->second.entries) visit(entry);
        }
      }
    }
  }

 private:
  static constexpr std::size_t kVisits = 32;
  using Cell = std::array<std::int64_t, 3>;
  struct Content {
    std::vector<Entry> entries;
    std::size_t visits = 0, last_node = 0;  // of the run that was added last
  };
  static Cell cell_of(const Eigen::Vector3d& p_m);
  static std::uint64_t key(const Cell& cell);
  std::unordered_map<std::uint64_t, Content> cells_;
};

// Compares runs with those that are near them.
class RunLinker {
 public:
  RunLinker(std::span<const std::vector<Node>> nodes, std::span<const Run> runs);
  // What `run` shares with each run of `near`, by rising number of the other.
  std::vector<RunLink> links_of(std::size_t run, const NearNodes& near);
  // Pairs of nodes that were compared so far.
  [[nodiscard]] std::size_t comparisons() const { return comparisons_; }

 private:
  struct Match {
    std::size_t node, other;
    bool backward;
  };
  // Another run, as the run that is compared sees it.
  struct Other {
    double apart_m = 0.0;  // of its nearest node to the node of the moment
    std::size_t at = 0;    // one more than that node; 0: none yet
    std::vector<Match> matches;
  };
  static bool longest_link(const std::vector<Match>& matches, RunLink& out);

  std::span<const std::vector<Node>> nodes_;
  std::span<const Run> runs_;
  std::vector<Other> others_;  // by run; without matches between two calls
  std::size_t comparisons_ = 0;
};

}  // namespace asperity
