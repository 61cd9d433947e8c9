#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/geometry/pose.h"

namespace asperity {

// What an iteration belongs to. A registration takes them in this order, and leaves out what it does not need.
enum class RegistrationPhase {
  kSearch,      // coarse runs from anywhere, where there is no guess
  kAnnealing,   // from the guess with few points, closest points first counting in all directions
  kFit,         // all points, from the best of these
  kRestarts,    // coarse runs from other poses near the guess
  kComparison,  // the best ends of these, with all points
  kGuesses,     // whole registrations from other guesses, for the refinement
  kRefinement,  // with the tracker's drift, from each of these
};
inline constexpr std::array<std::string_view, 7> kRegistrationPhaseNames{
    "search", "annealing", "fit", "restarts", "comparison", "guesses", "refinement"};

// One iteration of a registration: the pose that it began from, and how the path lay there.
struct RegistrationIteration {
  RegistrationPhase phase = RegistrationPhase::kAnnealing;
  int start = 0;  // which of the phase's starts
  Pose T_mesh_world;
  double rms_m = 0.0;       // of the inliers' distances
  std::size_t points = 0;   // that took part
  std::size_t inliers = 0;  // of them: paired, and within the width of the robust weight
};

// Watches a registration. It is called on the thread that registers; what it does takes that thread's time, and it
// changes nothing: without it the same bits come out.
struct RegistrationObserver : Observer {
  RegistrationObserver() = default;
  RegistrationObserver(const Observer& observer)  // NOLINT(google-explicit-constructor): most watch progress alone
      : Observer(observer) {}

  std::function<void(const RegistrationIteration&)> iterated;  // may be empty
};

}  // namespace asperity
