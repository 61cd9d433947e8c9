#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/profile/profile_pass.h"

namespace asperity {

// A part of a scan's path over a line that another part, of the same scan or of another one, is over too.
struct LinePass {
  std::size_t scan = 0;
  std::size_t first = 0, last = 0;  // points of the scan's path, `last` not among them
  PassPlace place;                  // on the line
};

using SharedLine = std::vector<LinePass>;

// Where paths are over the same line: within 0.6 mm of each other for at least 15 mm, along it or against it. A path is
// cut where it turns by more than 70° within 3 mm; a part that is over itself without such a turn (twice round a
// bottle) is not found. `paths`: points of each scan in one frame, `spacing_m` apart along the path; points that are
// not finite are on no line. No part is in two lines: the part that shares the most of its length takes those that
// share it with it, then the next. The line is that part's, and its own place is the origin.
//
// The work grows with the paths' length, not with its square: where more than 64 parts are within 0.6 mm, the part that
// takes the others is the one that shares the most with a sample of 64, and of a part that comes through 0.6 mm more
// than 32 times the first 32 count. `comparisons`: receives how many pairs of points were compared.
std::vector<SharedLine> find_shared_lines(std::span<const std::vector<Eigen::Vector3d>> paths, double spacing_m,
                                          std::size_t* comparisons = nullptr);

}  // namespace asperity
