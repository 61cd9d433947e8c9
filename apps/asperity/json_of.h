#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace asperity::app {

// JSON has no nan and no infinity.
nlohmann::ordered_json number_or_null(double value);
// Numbers as JSON arrays; one that is not finite becomes null.
nlohmann::ordered_json json_of(const Eigen::Ref<const Eigen::VectorXd>& values);
nlohmann::ordered_json json_of_rows(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

}  // namespace asperity::app
