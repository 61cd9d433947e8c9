#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/registration/weigh_poses.h"
#include "match_points.h"

namespace asperity::registration {

// The likelihood of poses, the errors along the paths allowed for (weigh_poses.h has the model).
class PathLikelihood {
 public:
  PathLikelihood(std::span<const MeasuredPath> paths, const RegistrationSurface& surface, const PointSet& points,
                 const MatchRules& rules, const WeighConfig& config);

  // The two scales that each pose has of its own.
  struct Scales {
    double slow_ratio = 1.0;  // of the slow error's standard deviation over the stated one
    double noise_m = 0.0;     // of a block's mean
  };
  struct Evaluation {
    CentredPose pose;
    Scales scales;
    double cost = 0.0;  // −2 log likelihood, with the prior of the scales
    Matrix6 information = Matrix6::Zero();
    double outlying = 0.0;  // share of the blocks
  };

  // At a pose, with the scales at which it is most likely.
  Evaluation evaluate(const CentredPose& pose);

  // Where Gauss–Newton from a pose ends.
  Evaluation descend(const CentredPose& start, int rounds, int steps);

 private:
  struct Block {
    std::uint32_t path = 0;
    double s_m = 0.0;
    std::size_t first = 0, count = 0;  // of the matcher's points
  };
  struct Height {
    double d_m = 0.0;
    Vector6 row = Vector6::Zero();
    Eigen::Vector3d n_world = Eigen::Vector3d::Zero();
    bool usable = false;
  };
  struct Sums {
    double cost = 0.0;
    Matrix6 information = Matrix6::Zero();
    Vector6 gradient = Vector6::Zero();
    std::size_t outlying = 0;
  };

  void measure(const CentredPose& pose);
  template <bool kWithRows>
  Sums filter(const Scales& scales) const;
  Scales likeliest_scales(const Scales& near) const;
  double scales_cost(const Scales& scales) const;

  const PointSet& points_;
  WeighConfig config_;
  std::vector<Eigen::Matrix3d> covariance_m2_;  // of a path's slow error
  bool stated_ = true;                          // it is known
  std::vector<Block> blocks_;
  Matcher matcher_;
  std::vector<Height> heights_;  // of the blocks
  double least_m_ = 0.0;         // of the noise
};

}  // namespace asperity::registration
