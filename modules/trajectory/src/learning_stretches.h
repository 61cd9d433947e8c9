#pragma once

#include <vector>

#include "inertial_smoother.h"

// The parts of a long recording that its noise is learnt from, but for the last step, which is from the whole.
namespace asperity::inertial_smoother {

// On the problem's time line, s.
struct Stretch {
  double begin = 0.0;
  double end = 0.0;
};

inline constexpr double kStretchLength_s = 3.0;
inline constexpr int kStretches = 9;

// Nine stretches of 3 s for a recording of more than twice their length, none for a shorter one (all of it is to be
// learnt from). Three are evenly spaced in time from the first to the last, three in the order of how much the specific
// force moves, three in the order of how rough the poses' path is (its fourth difference, in which a hand's motion is
// far below a tracker's noise): the stillest and the liveliest, the best and the worst tracked are among them.
std::vector<Stretch> choose_stretches(const Problem& problem);

// The problem of these stretches alone, the whole without any: the motion begins anew in each, the constants are the
// same in all.
Problem problem_of_stretches(const Problem& problem, const std::vector<Stretch>& stretches);

}  // namespace asperity::inertial_smoother
