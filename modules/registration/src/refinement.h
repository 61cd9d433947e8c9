#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "asperity/registration/refine_registration.h"
#include "overlaps.h"
#include "path_chain.h"
#include "whitening.h"

namespace asperity::registration {

inline constexpr std::size_t kLeastPoints = 30;  // with fewer there is nothing to refine

// What is known of a placement before: a pose, and how well. Turns and shifts are about `centre_mesh_m`.
struct PosePrior {
  Pose T_mesh_world;
  Eigen::Vector3d centre_mesh_m = Eigen::Vector3d::Zero();
  std::vector<UndeterminedMotion> held;  // motions along which the pose stays
};

// The normal equations of a step: poses (turn, shift of each placement), tips, bulge, levels, then knots. Only the
// lower triangle is there.
struct Equations {
  Eigen::SparseMatrix<double> information;
  Eigen::VectorXd right;
  double cost = 0.0;
  std::size_t rows = 0;
};

// The equations of refine_registration.h and refine_placements.h.
class Refinement {
 public:
  // One prior a placement.
  Refinement(const PathChain& chain, const MeshSurface& surface, std::vector<PosePrior> priors,
             const RefineConfig& config);

  const PathChain& chain() const { return chain_; }
  bool slow() const { return slow_; }
  const Eigen::Vector3d& centre_m(std::size_t placement) const { return priors_[placement].centre_mesh_m; }
  Eigen::Index bulge_at() const { return tips_at() + 3 * static_cast<Eigen::Index>(chain_.tip_sigma_m.size()); }
  void set_overlaps(std::vector<OverlapLink> links) { links_ = std::move(links); }

  FacetHeights heights(const State& state) const {
    return measure_heights(chain_, state, surface_, config_.outlier_sigmas);
  }
  Equations equations(const State& state, const FacetHeights& heights, std::span<const Whitening> whitening) const;
  // Of each path the mean of w² over its variance, times the path's points; of the overlaps; and the priors'.
  double cost(const State& state, const FacetHeights& heights, std::span<const Whitening> whitening) const;
  // Without the poses' priors: what is compared between groupings.
  double likelihood_cost(const State& state, const FacetHeights& heights, std::span<const Whitening> whitening) const;
  State moved(const State& state, const Eigen::VectorXd& step) const;
  Eigen::Index size() const { return knots_at_ + (slow_ ? 3 * static_cast<Eigen::Index>(chain_.knot_count) : 0); }

 private:
  // Calls visit(i) for each point of a part whose whitened height is complete.
  template <class Visit>
  void for_whitened(const PathChain::Part& part, const FacetHeights& heights, std::size_t order, Visit visit) const {
    std::size_t run = 0;
    for (std::size_t i = part.first_point; i < part.first_point + part.points; ++i) {
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
  Eigen::Index tips_at() const { return 6 * static_cast<Eigen::Index>(chain_.placement_count); }
  Eigen::Index levels_at() const { return bulge_at() + 1; }

  const PathChain& chain_;
  const MeshSurface& surface_;
  std::vector<PosePrior> priors_;
  const RefineConfig& config_;
  bool slow_ = false;
  Eigen::Index knots_at_ = 0;                      // where they begin among the unknowns
  std::vector<Eigen::Triplet<double>> precision_;  // of the knots' prior, both triangles, offsets within the knots
  Eigen::SparseMatrix<double> prior_knots_;
  Vector6 guess_precision_;
  std::vector<OverlapLink> links_;
};

}  // namespace asperity::registration
