#pragma once

#include <Eigen/Core>

#include "asperity/studio/block.h"
#include "study/study_session.h"

namespace asperity::studio {

// (i, j): how often stimulus i was preferred to j, in a study by pairs.
Eigen::MatrixXd count_wins(const StudySession& session);

// What a session gives, as far as it is (docs/studio-study.md): by pairs {"wins","pairs","worths","left"}, a staircase
// {"target","tracks"}, ratings {"ratings"}; and what all have.
Json study_results(const StudySession& session);

}  // namespace asperity::studio
