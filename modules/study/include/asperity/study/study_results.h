#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "asperity/study/study_session.h"

namespace asperity {

// (i, j): how often stimulus i was preferred to j, in a study by pairs.
Eigen::MatrixXd count_wins(const StudySession& session);

// What a session gives, as far as it is (docs/studio-study.md): by pairs {"wins","pairs","worths","left"}, a staircase
// {"target","tracks"}, ratings {"ratings"}; and what all have.
nlohmann::ordered_json study_results(const StudySession& session);

}  // namespace asperity
