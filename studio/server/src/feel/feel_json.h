#pragma once

#include <string>
#include <vector>

#include "feel/feel_run.h"

namespace asperity::studio {

// How a run went: its end, figures, doubts and warnings in words, and how well the schedule of `servo` was kept.
Json outcome_json(const FeelOutcome& outcome, const ServoConfig& servo);

}  // namespace asperity::studio
