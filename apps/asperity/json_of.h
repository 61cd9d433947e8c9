#pragma once

#include <Eigen/Core>

#include "asperity/json/json.h"

namespace asperity::app {

// Numbers as JSON arrays; one that is not finite becomes null.
Json json_of(const Eigen::Ref<const Eigen::VectorXd>& values);
Json json_of_rows(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

}  // namespace asperity::app
