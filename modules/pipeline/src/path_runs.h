#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace asperity {

inline constexpr double kNode_m = 0.25e-3;        // between the points that are compared
inline constexpr double kShortestLine_m = 15e-3;  // shorter, two parts share no line

inline std::size_t nodes_in(double length_m) { return static_cast<std::size_t>(std::lround(length_m / kNode_m)); }

struct Node {
  Eigen::Vector3d p_m, direction;
  bool is_known = false;
};

// A part of a scan's path without turns; nodes of the scan, `last` not among them.
struct Run {
  std::size_t scan = 0, first = 0, last = 0;
};

// Every `step`-th point of a path, with its direction where it has one.
std::vector<Node> make_nodes(const std::vector<Eigen::Vector3d>& path, std::size_t step);

// Adds the parts of a path between its turns that are long enough.
void add_runs(const std::vector<Node>& nodes, std::size_t scan, std::vector<Run>& out);

}  // namespace asperity
