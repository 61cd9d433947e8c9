#pragma once

#include <span>
#include <vector>

#include "asperity/registration/register_path.h"

namespace asperity {

struct SearchConfig {
  int rotations = 600;
  int positions = 150;
  int points = 24;
  int grid_runs = 8000;
  int coarse_points = 100;
  int coarse_runs = 100;
  int distinct = 30;
  int refined = 5;
  bool rivals = true;
  RegistrationConfig registration;

  template <class V>
  void visit(V& v) {
    v.field("rotations", rotations, "evenly spread ones that are tried", {1, 1000000});
    v.field("positions", positions, "points of the surface that the path's middle is laid on", {1, 1000000});
    v.field("points", points, "of the path at which each of these poses is scored", {3, 100000});
    v.field("grid_runs", grid_runs, "best scores that are descended on a grid of distances", {1, 1e6});
    v.field("coarse_points", coarse_points, "of the path for the coarse runs", {20, 100000});
    v.field("coarse_runs", coarse_runs, "best distinct ends of these from which ICP is run coarsely", {1, 100000});
    v.field("distinct", distinct, "best distinct ends of that whose likelihoods are compared", {1, 10000});
    v.field("refined", refined, "best ends of these that are run to the end", {1, 1000});
    v.field("rivals", rivals, "poses anywhere on the mesh are weighed against the one found, with a guess too");
    v.group("registration", registration);
  }
};

// Poses anywhere on the mesh at which the paths fit it, the best first: rotations of a super-Fibonacci spiral (Alexa
// 2022) times points spread over the surface, all scored at a few points and the better of them descended on a grid of
// distances, the distinct ends descended on the mesh itself. Throws Error as register_path does, and for more than 10^8
// poses; and Cancelled.
std::vector<Pose> find_poses(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                             const SearchConfig& config, const RegistrationObserver& observer = {});

// The registration without a guess: the best of find_poses run to the end. The best of these is the result, the next
// the runner-up, which decides whether it is valid. A motion that the paths do not determine is arbitrary. Throws
// as find_poses does.
RegistrationResult find_registration(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                                     const SearchConfig& config, const RegistrationObserver& observer = {});

}  // namespace asperity
