#include "asperity/registration/refine_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "asperity/algebra/solve.h"
#include "descend.h"
#include "find_unobservable_dofs.h"
#include "iteration_watch.h"
#include "path_chain.h"
#include "pose_motion.h"
#include "refine_settings.h"
#include "refinement.h"
#include "whitening.h"

namespace asperity {

namespace {

using registration::FacetHeights;
using registration::IterationWatch;
using registration::kLeastPoints;
using registration::PathChain;
using registration::PosePrior;
using registration::Refined;
using registration::Refinement;
using registration::State;
using registration::Vector6;
using registration::Whitening;

constexpr int kRounds = 3;

// Whether the runner-up, whose cost (−2 log likelihood) is higher by `excess`, is still as good.
void resolve_ambiguity(double excess, RegistrationResult& result) {
  constexpr double kDecisive = 18.0;  // e⁹ : 1
  if (!(excess > kDecisive)) return;
  constexpr double kLeastInliers = 0.5;
  const auto points = static_cast<double>(result.points);
  result.ambiguous = false;
  result.trustworthy = result.converged && static_cast<double>(result.outliers) <= (1.0 - kLeastInliers) * points;
  result.verdict.resize(std::min(result.verdict.size(), result.verdict.find(" Ambiguous:")));
  result.verdict += fmt::format(
      " The next best pose, {:.2f} mm and {:.2f} degrees away, is less likely by a factor of e^{:.0f}.",
      1e3 * result.runner_up->distance_m, result.runner_up->rotation_rad * 180.0 / std::numbers::pi, 0.5 * excess);
}

// Where a descent ended.
struct LocalMinimum {
  double cost = 0.0;
  Pose T_mesh_world;
  double rms_m = 0.0;
};

// Another minimum that is nearly as deep makes the result ambiguous (seed Fig. 25). The same minimum ends within what
// the covariance allows, or a millimetre.
void report_rival_minimum(const PathChain& chain, const std::vector<LocalMinimum>& minima, RegistrationResult& result) {
  constexpr double kNearly = 9.0;      // −2 log likelihood: 90 : 1
  constexpr double kSame = 5.0 * 5.0;  // squared standard deviations
  constexpr double kSame_m = 1e-3;
  double lowest = std::numeric_limits<double>::infinity();
  for (const LocalMinimum& minimum : minima) lowest = std::min(lowest, minimum.cost);
  const LocalMinimum* rival = nullptr;
  double rival_m = 0.0;
  for (const LocalMinimum& minimum : minima) {
    if (!(minimum.cost < lowest + kNearly) || (rival != nullptr && minimum.cost >= rival->cost)) continue;
    double square_m2 = 0.0;
    std::size_t count = 0;
    for (const Eigen::Vector3d& p_m : chain.p_world_m) {
      if (!p_m.allFinite()) continue;
      square_m2 += (minimum.T_mesh_world * p_m - result.T_mesh_world * p_m).squaredNorm();
      ++count;
    }
    const double distance_m = std::sqrt(square_m2 / static_cast<double>(std::max<std::size_t>(1, count)));
    const Vector6 change = registration::pose_change(result.T_mesh_world, minimum.T_mesh_world, result.centre_mesh_m);
    if (distance_m < kSame_m || change.dot(solve_symmetric(result.covariance, change).col(0)) < kSame) continue;
    rival = &minimum;
    rival_m = distance_m;
  }
  if (rival == nullptr) return;
  const double rotation_rad = rival->T_mesh_world.rotation.angularDistance(result.T_mesh_world.rotation);
  result.runner_up = RunnerUp{rival->T_mesh_world, rival->rms_m, rival_m, rotation_rad};
  result.ambiguous = true;
  result.trustworthy = false;
  result.verdict += fmt::format(" Ambiguous: {:.2f} mm and {:.2f} degrees away it fits nearly as well ({:.4f} mm RMS).",
                                1e3 * rival_m, rotation_rad * 180.0 / std::numbers::pi, 1e3 * rival->rms_m);
}

}  // namespace

RefinedRegistration refine_registration(std::span<const MeasuredPath> paths, const MeshSurface& surface,
                                        const RegistrationResult& start, const std::optional<Pose>& guess,
                                        std::span<const Pose> others, const RefineConfig& given,
                                        const RegistrationObserver& observer) {
  IterationWatch watch(observer);
  watch.begin(RegistrationPhase::kRefinement);
  RefinedRegistration out;
  out.registration = start;
  out.slow_error_world_m.resize(paths.size());
  if (!given.enabled) return out;
  const RefineConfig config = registration::with_few_knots(paths, given, out.registration.problems);
  const auto give_up = [&](const std::string& why) {
    out.registration.problems.push_back({"not_refined", "the pose was not refined: " + why, 1});
    return out;
  };

  const PathChain chain = registration::make_chain(paths, config.knot_m);
  const std::vector<UndeterminedMotion> held = registration::held_motions(start);
  const PosePrior prior{guess.value_or(start.T_mesh_world), start.centre_mesh_m, held};
  const Refinement problem(chain, surface, {prior}, config),
      unheld(chain, surface, {{prior.T_mesh_world, start.centre_mesh_m, {}}}, config);
  const State first = registration::zero_state(chain, {start.T_mesh_world});
  const FacetHeights heights = problem.heights(first);
  if (heights.count < kLeastPoints || !(chain.spacing_m > 0.0)) return give_up("too few points are over the mesh");
  const auto filters = [&](const FacetHeights& at) { return registration::learn_whitenings(chain, at, config); };

  // The minimum of the start, with the relief's spectrum as it is there; then all minima with that spectrum.
  std::vector<Whitening> whitening = filters(heights);
  if (!registration::has_variance(whitening)) return give_up("the path is on the mesh exactly");
  Refined best = descend_to_minimum(problem, first, whitening, config.max_iterations, watch);
  int iterations = best.iterations;
  std::vector<LocalMinimum> minima;  // with the first round's whitening
  for (int round = 0; round < kRounds; ++round) {
    whitening = filters(best.heights);
    if (!registration::has_variance(whitening)) return give_up("the path is on the mesh exactly");
    best = descend_to_minimum(problem, best.state, whitening, config.max_iterations, watch);
    iterations += best.iterations;
    if (round > 0) continue;
    minima.push_back({best.cost, best.state.T_mesh_world.front(), best.heights.rms_m});
    for (const Pose& pose : others) {
      State other = first;
      other.T_mesh_world = {pose};
      Refined there = descend_to_minimum(problem, other, whitening, config.max_iterations, watch);
      iterations += there.iterations;
      minima.push_back({there.cost, there.state.T_mesh_world.front(), there.heights.rms_m});
      if (there.cost < best.cost) best = std::move(there);
    }
  }
  if (!std::isfinite(best.cost) || best.information.rows() == 0)
    return give_up("the path has no unbroken stretch over the mesh");
  RegistrationResult& result = out.registration;
  result.covariance = registration::inverse_columns(best.information, 0, 6).topRows<6>() +
                      registration::held_covariance(held, config.guess_sigma_m);
  result.T_mesh_world = best.state.T_mesh_world.front();
  result.rms_m = best.heights.rms_m;
  result.iterations += iterations;
  registration::append_uncertain_rotations(chain, config.undetermined_deg * std::numbers::pi / 180.0, result);
  if (start.ambiguous && start.runner_up) {
    State other = first;
    other.T_mesh_world = {start.runner_up->T_mesh_world};
    resolve_ambiguity(descend_to_minimum(unheld, other, whitening, config.max_iterations, watch).cost - best.cost,
                      result);
  }
  report_rival_minimum(chain, minima, result);
  result.verdict += fmt::format(" With drift of the tracker allowed for: residual {:.4f} mm RMS", 1e3 * result.rms_m);
  for (std::size_t i = start.undetermined.size(); i < result.undetermined.size(); ++i) {
    result.verdict += (i == start.undetermined.size() ? "; but " : ", ") + result.undetermined[i].description;
  }
  result.verdict += ".";
  if (!problem.slow()) return out;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    const PathChain::Part& part = chain.parts[p];
    for (std::size_t i = 0; i < part.points; ++i) {
      out.slow_error_world_m[p].push_back(registration::slow_error_m(chain, best.state, part.first_point + i));
    }
  }
  return out;
}

}  // namespace asperity
