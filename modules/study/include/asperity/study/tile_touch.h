#pragma once

namespace asperity {

// For how long one texture of a trial was touched, and how hard.
struct TileTouch {
  double touch_s = 0.0;  // with at least StudyPresentation::least_force_N
  double force_N = 0.0;  // on the hand, the mean over that time; 0 without it

  bool operator==(const TileTouch&) const = default;
};

}  // namespace asperity
