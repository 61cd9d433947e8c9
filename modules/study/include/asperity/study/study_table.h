#pragma once

#include <string>
#include <vector>

#include "asperity/study/study_log.h"

namespace asperity {

// One row for each answer that counts, of all logs in their order, as R and spreadsheets read it
// (docs/studio-study.md): study, method, participant, run, trial, repetition, left, right, chosen, rating, comparison,
// level, correct, response_s, touch_left_s, touch_right_s, force_left_N, force_right_N. What does not apply is empty.
// Fields with commas are quoted (RFC 4180). Throws Error if two logs are of the same study, participant and run:
// answers would count twice.
std::string format_study_table(const std::vector<StudyLog>& logs);

}  // namespace asperity
