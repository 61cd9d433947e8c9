#include "force3_json.h"

#include <cmath>

#include <Eigen/SVD>

#include "plain_number.h"

namespace asperity {

namespace {

bool take_three(const Json* list, Eigen::Ref<Eigen::Vector3d> out) {
  if (list == nullptr || !list->is_array() || list->size() != 3) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(*list)[i].is_number() || !std::isfinite((*list)[i].get<double>())) return false;
    out[static_cast<Eigen::Index>(i)] = (*list)[i].get<double>();
  }
  return true;
}

Json three(const Eigen::Vector3d& v) { return {plain_number(v.x()), plain_number(v.y()), plain_number(v.z())}; }

}  // namespace

Json force3_json(const Force3Calibration& force3) {
  Json B = Json::array();
  for (Eigen::Index r = 0; r < 3; ++r) B.push_back(three(force3.B.row(r)));
  return {{"B", B}, {"C", three(force3.C)}, {"residual_newton", three(force3.residual_newton)}};
}

bool take_force3(const Json& value, std::optional<Force3Calibration>& out) {
  if (!value.is_object()) return false;
  const Json* B = value.find("B");
  if (B == nullptr || !B->is_array() || B->size() != 3) return false;
  Force3Calibration force3;
  for (std::size_t r = 0; r < 3; ++r) {
    Eigen::Vector3d row;
    if (!take_three(&(*B)[r], row)) return false;
    force3.B.row(static_cast<Eigen::Index>(r)) = row;
  }
  if (!take_three(value.find("C"), force3.C) || !take_three(value.find("residual_newton"), force3.residual_newton))
    return false;
  constexpr double kLeastRelativeSingularValue = 1e-9;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(force3.B);
  if (!(svd.singularValues()[2] > kLeastRelativeSingularValue * svd.singularValues()[0])) return false;
  // What says more, or says it otherwise, would not come back.
  if (force3_json(force3).dump_sorted() != value.dump_sorted()) return false;
  out = force3;
  return true;
}

}  // namespace asperity
