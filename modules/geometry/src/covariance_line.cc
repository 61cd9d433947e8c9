#include "asperity/geometry/covariance_line.h"

#include <stdexcept>
#include <utility>

namespace asperity {

CovarianceLine CovarianceLine::between(std::vector<Eigen::Matrix3d> nodes, std::size_t samples) {
  CovarianceLine out;
  out.is_between_ = true;
  out.nodes_ = std::move(nodes);
  out.node_.reserve(samples);
  out.share_.reserve(samples);
  return out;
}

Eigen::Matrix3d CovarianceLine::at(std::size_t i) const {
  if (i >= size()) throw std::out_of_range("CovarianceLine::at");
  return (*this)[i];
}

void CovarianceLine::push_back(const Eigen::Matrix3d& covariance) {
  hold_each();
  nodes_.push_back(covariance);
}

void CovarianceLine::set(std::size_t i, const Eigen::Matrix3d& covariance) {
  hold_each();
  nodes_[i] = covariance;
}

void CovarianceLine::append(const CovarianceLine& from) {
  for (const Eigen::Matrix3d& covariance : from) push_back(covariance);
}

void CovarianceLine::assign(std::size_t count, const Eigen::Matrix3d& covariance) {
  clear();
  nodes_.assign(count, covariance);
}

void CovarianceLine::hold_each() {
  if (!is_between_) return;
  std::vector<Eigen::Matrix3d> each(begin(), end());
  clear();
  nodes_ = std::move(each);
}

}  // namespace asperity
