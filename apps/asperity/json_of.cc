#include "json_of.h"

#include <cmath>

namespace asperity::app {

Json json_of(const Eigen::Ref<const Eigen::VectorXd>& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(number_or_null(value));
  return out;
}

Json json_of_rows(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  Json out = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) out.push_back(json_of(matrix.row(i).transpose()));
  return out;
}

}  // namespace asperity::app
