#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace asperity::app {

// Numbers as JSON arrays; one that is not finite becomes null.
nlohmann::ordered_json json_of(const Eigen::Ref<const Eigen::VectorXd>& values);
nlohmann::ordered_json json_of_rows(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

}  // namespace asperity::app
