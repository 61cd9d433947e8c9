#pragma once

#include <string>
#include <vector>

#include "asperity/studio/project.h"
#include "feel/feel_run.h"

namespace asperity::studio {

// How a run went: its end, figures, doubts and warnings in words, and how well the schedule of `servo` was kept.
Json outcome_json(const FeelOutcome& outcome, const ServoConfig& servo);

// "feel.csv", "feel_2.csv", …: the first that is free in the project's folder.
std::string free_log_name(const Project& project);

}  // namespace asperity::studio
