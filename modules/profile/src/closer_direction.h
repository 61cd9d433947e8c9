#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "even_path.h"

namespace asperity {

enum class PathPart : char { kStraight, kBend, kBesideBend };

// The parts of a path, one a cell. A bend is where `cut` marks that the slow path cuts one by more than noise could,
// and what is bent, by 5° between the directions of the two paths, within `reach` cells of it. What is not bent there
// is neither bend nor straight.
std::vector<PathPart> find_bends(const EvenPath<2>& slow, const EvenPath<2>& quick, const std::vector<char>& moving,
                                 const std::vector<char>& cut, std::size_t reach);

// Marks as bends the cells of reversals: where the quick path turns by more than 60° within `side` cells on either side
// and the sharp one moves. Rows that are close together are cut by less than noise could, but a turn is certain.
void mark_reversals(const EvenPath<2>& quick, const EvenPath<2>& sharp, const std::vector<char>& moving,
                    double rest_mps, std::size_t side, std::vector<PathPart>& parts);

// Bends by the direction of a path that follows them closer than `tangent` does (docs/profile-bends.md). Noise and
// tremor turn that direction too: a velocity w across the path lengthens it by w²/(2 v) a second. What that is where
// the path is straight, or beside bends where little of it is, gives w², and with it what is left out.
class CloserDirection {
 public:
  // All one a cell; rest_mps, slower than which the tip counts as moving with this.
  CloserDirection(const EvenPath<2>& sharp, const std::vector<Eigen::Vector2d>& tangent,
                  const std::vector<char>& moving, std::vector<PathPart> parts, double rest_mps);

  double added_m() const { return added_m_; }  // to the length by all bends, noise included
  // What of a step in a cell the closer direction adds, less what it adds by noise; 0 outside bends.
  double added_m(std::size_t cell, const Eigen::Vector2d& step_m) const {
    return share_ > 0.0 && parts_[cell] == PathPart::kBend ? share_ * turned_[cell].dot(step_m) : 0.0;
  }

 private:
  std::vector<PathPart> parts_;
  std::vector<Eigen::Vector2d> turned_;
  double share_ = 0.0, added_m_ = 0.0;
};

}  // namespace asperity
