#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/registration/weigh_poses.h"
#include "filter_path.h"
#include "match_points.h"
#include "path_blocks.h"

namespace asperity::registration {

// The likelihood of poses, the errors along the paths allowed for (weigh_poses.h has the model).
class PathLikelihood {
 public:
  PathLikelihood(std::span<const MeasuredPath> paths, const RegistrationSurface& surface, const PointSet& points,
                 const MatchRules& rules, const WeighConfig& config);

  // The scales that each pose has of its own.
  struct Scales {
    double slow_ratio = 1.0;      // of the slow error's standard deviation over the stated one
    std::vector<double> noise_m;  // of a block's mean, of each path
  };
  struct Evaluation {
    CentredPose pose;
    Scales scales;
    double cost = 0.0;              // −2 log likelihood, with the prior of the scales
    double log_precision = 0.0;     // logarithm of the determinant of the information, with the prior's
    double slow_ratio_sigma = 0.0;  // standard error of the logarithm of scales.slow_ratio, by the path alone
    Matrix6 information = Matrix6::Zero();
    double outlying = 0.0;  // share of the blocks

    // −2 log of the likelihood with the pose integrated out (Laplace), by which scales and poses are compared.
    double restricted() const { return cost + log_precision; }
  };

  // At a pose, with the scales of largest restricted likelihood (Patterson and Thompson 1971): the pose has taken six
  // degrees of freedom out of the heights, which the likelihood itself does not count.
  Evaluation evaluate(const CentredPose& pose);

  // Where Gauss–Newton from a pose ends.
  Evaluation descend(const CentredPose& start, int rounds, int steps);

  // The same with the mesh's size free (mesh_scale.h has the model): the pose is that of the points, drawn together by
  // 1/size, on the mesh as it is.
  struct Scaled {
    Evaluation at;
    double log_size = 0.0;
    Matrix10 information = Matrix10::Zero();  // of pose, log_size and the tip's position (marker axes)
  };
  static constexpr double kSizeSpread = 0.5;  // of log_size, a priori
  Scaled descend_with_size(const CentredPose& start, double log_size, int rounds, int steps);

 private:
  void measure(const CentredPose& pose, double log_size = 0.0);
  template <int kRows>
  using Prior = Eigen::Matrix<double, kRows, kRows>;  // what is known of the unknowns before, inverse covariance
  Prior<6> pose_prior(const CentredPose& pose) const;
  Prior<7> size_prior(const CentredPose& pose) const;
  template <int kRows>
  Evaluation evaluate_measured(const CentredPose& pose, const Prior<kRows>& prior) const;
  std::vector<double> noise_of_bends() const;
  template <int kRows>
  FilterSums<kRows> filter(const Scales& scales) const;
  Scales likeliest_scales(const Scales& near) const;
  template <int kRows>
  Scales restricted_scales(Scales scales, const Prior<kRows>& prior) const;
  template <int kRows>
  double restricted_cost(const Scales& scales, const Prior<kRows>& prior) const;
  double scales_prior(double slow_ratio) const;

  const PointSet& points_;
  WeighConfig config_;
  PathBlocks blocks_;
  std::vector<Eigen::Matrix3d> R_marker_world_;  // of the matcher's points; empty if the paths have no orientation
  Matcher matcher_;
  std::vector<BlockHeight> heights_;  // of the blocks
  double least_m_ = 0.0;              // of the noise
};

}  // namespace asperity::registration
