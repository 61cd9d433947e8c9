#pragma once

#include "inertial_smoother.h"

namespace asperity::inertial_smoother {

// By how much the log-likelihood of the poses grows with the best of the twelve other conventions of the tracker's axes
// (one to three of them negative, two exchanged, three in a circle), under the noise that was learnt with the stated
// one. Below zero: the stated one is the likeliest. Forward passes only; the problem's weights of poses are kept, so
// that all conventions are judged by the same poses. `problem` has no restarts and knows its weights.
double best_other_axes(const Problem& problem);

}  // namespace asperity::inertial_smoother
