#pragma once

#include <span>

#include "asperity/registration/register_path.h"

namespace asperity {

struct SearchConfig {
  int rotations = 600;
  int positions = 60;
  int points = 24;
  int coarse_points = 80;
  int coarse_runs = 120;
  int refined = 5;
  RegistrationConfig registration;

  template <class V>
  void visit(V& v) {
    v.field("rotations", rotations, "evenly spread ones that are tried", {1, 1000000});
    v.field("positions", positions, "points of the surface that the path's middle is laid on", {1, 1000000});
    v.field("points", points, "of the path at which each of these poses is scored", {3, 100000});
    v.field("coarse_points", coarse_points, "of the path for the coarse runs", {20, 100000});
    v.field("coarse_runs", coarse_runs, "best scores from which ICP is run coarsely", {1, 100000});
    v.field("refined", refined, "best ends of these that are run to the end", {1, 1000});
    v.group("registration", registration);
  }
};

// The registration without a guess: rotations of a super-Fibonacci spiral (Alexa 2022) times points spread over the
// surface, scored at a few points; the best run coarsely, the best of these to the end. The best is the
// result, the next the runner-up, which decides whether it can be trusted. A motion that the paths do not determine is
// arbitrary. Throws Error as register_path does, and for more than 10^8 poses; and Cancelled.
RegistrationResult find_registration(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                                     const SearchConfig& config, const RegistrationObserver& observer = {});

}  // namespace asperity
