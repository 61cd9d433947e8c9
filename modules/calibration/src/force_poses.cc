#include "force_poses.h"

#include <algorithm>

namespace asperity {

Eigen::Matrix<double, 9, 1> quadric_features(const Eigen::Vector3d& f) {
  Eigen::Matrix<double, 9, 1> out;
  out << f, f.cwiseAbs2(), f.x() * f.y(), f.x() * f.z(), f.y() * f.z();
  return out;
}

ForcePoses group_by_force(const AccelerometerSamples& samples, double near_mps2) {
  const auto& force = samples.specific_force_mps2;
  std::vector<std::size_t> begin;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i == 0 || (force[i] - force[begin.back()]).norm() > near_mps2) begin.push_back(i);
  }
  begin.push_back(samples.size());
  std::vector<std::size_t> lengths;
  for (std::size_t p = 0; p + 1 < begin.size(); ++p) lengths.push_back(begin[p + 1] - begin[p]);
  std::sort(lengths.rbegin(), lengths.rend());
  std::size_t covered = 0;
  std::size_t usual = 0;
  for (const std::size_t length : lengths) {
    covered += length;
    usual = length;
    if (2 * covered >= samples.size()) break;
  }

  ForcePoses out;
  const auto most = static_cast<Eigen::Index>(lengths.size());
  out.counts.resize(most, 3);
  out.features.resize(most, 9);
  Eigen::Index poses = 0;
  for (std::size_t p = 0; p + 1 < begin.size(); ++p) {
    const std::size_t length = begin[p + 1] - begin[p];
    if (10 * length < usual) continue;
    Eigen::Vector3d counts = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 9, 1> features = Eigen::Matrix<double, 9, 1>::Zero();
    for (std::size_t i = begin[p]; i < begin[p + 1]; ++i) {
      counts += samples.counts[i];
      features += quadric_features(force[i]);
    }
    out.counts.row(poses) = counts.transpose() / static_cast<double>(length);
    out.features.row(poses) = features.transpose() / static_cast<double>(length);
    ++poses;
  }
  out.counts.conservativeResize(poses, 3);
  out.features.conservativeResize(poses, 9);
  return out;
}

ForcePoses average_pairs(const ForcePoses& poses) {
  const Eigen::Index pairs = poses.size() / 2;
  ForcePoses out;
  out.counts.resize(pairs, 3);
  out.features.resize(pairs, 9);
  for (Eigen::Index p = 0; p < pairs; ++p) {
    out.counts.row(p) = 0.5 * (poses.counts.row(2 * p) + poses.counts.row(2 * p + 1));
    out.features.row(p) = 0.5 * (poses.features.row(2 * p) + poses.features.row(2 * p + 1));
  }
  return out;
}

}  // namespace asperity
