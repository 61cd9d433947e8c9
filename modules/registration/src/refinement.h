#pragma once

#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/registration/refine_registration.h"
#include "path_chain.h"
#include "whitening.h"

namespace asperity::registration {

inline constexpr std::size_t kLeastPoints = 30;  // with fewer there is nothing to refine

// Pose, slow errors and the mean relief of each path.
struct State {
  Pose T_mesh_world;
  Eigen::VectorXd knots_m;
  Eigen::VectorXd level_m;
};

struct Equations {
  Eigen::MatrixXd information;  // of turn, shift, levels and knots
  Eigen::VectorXd right;
  double cost = 0.0;  // the mean of w² over its variance, times the points, and the prior's
  std::size_t rows = 0;
};

// The equations of refine_registration.h.
class Refinement {
 public:
  // The guess counts as a weak prior, without one the start's pose.
  Refinement(const PathChain& chain, const MeshSurface& surface, const RegistrationResult& start,
             const std::optional<Pose>& guess, const RefineConfig& config);

  bool slow() const { return slow_; }
  FacetHeights heights(const State& state) const {
    return measure_heights(chain_, state.knots_m, state.level_m, surface_, state.T_mesh_world, config_.outlier_sigmas);
  }
  Equations equations(const State& state, const FacetHeights& heights, const Whitening& whitening) const;
  double cost(const State& state, const FacetHeights& heights, const Whitening& whitening) const;
  State moved(const State& state, const Eigen::VectorXd& step) const;

 private:
  // Calls visit(i) for each point whose whitened height is complete.
  template <class Visit>
  void for_whitened(const FacetHeights& heights, std::size_t order, Visit visit) const {
    std::size_t run = 0;
    for (std::size_t i = 0; i < heights.d_m.size(); ++i) {
      if (chain_.begins[i] != 0) run = 0;
      run = heights.usable[i] != 0 ? run + 1 : 0;
      if (run > order) visit(i);
    }
  }
  static double whitened(const FacetHeights& heights, const Whitening& whitening, std::size_t i) {
    double w = heights.d_m[i];
    for (std::size_t k = 1; k <= whitening.a.size(); ++k) w += whitening.a[k - 1] * heights.d_m[i - k];
    return w;
  }

  const PathChain& chain_;
  const MeshSurface& surface_;
  Pose guess_;
  Eigen::Vector3d centre_m_;
  const RefineConfig& config_;
  bool slow_;
  Eigen::Index knots_at_;  // where they begin among the unknowns
  Eigen::MatrixXd precision_;
  Vector6 guess_precision_;
};

}  // namespace asperity::registration
