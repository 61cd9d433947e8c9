#pragma once

#include <string>

#include "asperity/json/json.h"
#include "asperity/study/study_results.h"

namespace asperity {

// The results as one object (docs/studio-study.md): what all methods have, and by pairs
// {"wins","pairs","worths","left"}, of a staircase {"target","tracks","left"}, of ratings {"ratings"}.
Json study_results_json(const StudyResults& results);

// The same for a person, in lines. What is not determined is said to be so.
std::string study_results_text(const StudyResults& results);

}  // namespace asperity
