#include "asperity/registration/refine_placements.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "descend.h"
#include "find_unobservable_dofs.h"
#include "refine_settings.h"

namespace asperity {

namespace {

using registration::FacetHeights;
using registration::FacetKinks;
using registration::IterationWatch;
using registration::OverlapLink;
using registration::PathChain;
using registration::PosePrior;
using registration::Refined;
using registration::Refinement;
using registration::State;
using registration::Whitening;

constexpr int kJointRounds = 3;

std::vector<PosePrior> priors_of(std::span<const RegistrationResult> starts,
                                 std::span<const std::optional<Pose>> guesses) {
  std::vector<PosePrior> out;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const Pose known = k < guesses.size() && guesses[k] ? *guesses[k] : starts[k].T_mesh_world;
    out.push_back({known, starts[k].centre_mesh_m, registration::held_motions(starts[k])});
  }
  return out;
}

// The paths of one placement.
std::vector<MeasuredPath> members_of(std::span<const MeasuredPath> paths, std::span<const std::size_t> placement_of,
                                     std::size_t placement) {
  std::vector<MeasuredPath> out;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    if (placement_of[p] == placement) out.push_back(paths[p]);
  }
  return out;
}

double rms_of(const PathChain& chain, const FacetHeights& heights, std::size_t placement) {
  double square_m2 = 0.0, count = 0.0;
  for (std::size_t p = 0; p < chain.parts.size(); ++p) {
    if (chain.parts[p].placement != placement) continue;
    const auto n = static_cast<double>(heights.part_count[p]);
    square_m2 += n * heights.part_rms_m[p] * heights.part_rms_m[p];
    count += n;
  }
  return std::sqrt(square_m2 / std::max(1.0, count));
}

void read_paths(const PathChain& chain, const Refinement& problem, const Refined& best, RefinedPlacements& out) {
  out.rms_m = best.heights.part_rms_m;
  const Eigen::Index tips_at = 6 * static_cast<Eigen::Index>(chain.placement_count);
  const Eigen::Index bulge_at = tips_at + 3 * static_cast<Eigen::Index>(chain.tip_sigma_m.size());
  out.bulge_share = std::clamp(best.state.bulge, 0.0, 1.0);
  out.bulge_sigma = std::sqrt(std::max(0.0, registration::inverse_columns(best.information, bulge_at, 1)(bulge_at, 0)));
  const Eigen::Index tips = 3 * static_cast<Eigen::Index>(chain.tip_sigma_m.size());
  Eigen::MatrixXd tip_covariance_m2;
  if (tips > 0) tip_covariance_m2 = registration::inverse_columns(best.information, tips_at, tips);
  for (std::size_t p = 0; p < chain.parts.size(); ++p) {
    const PathChain::Part& part = chain.parts[p];
    if (part.has_tip) {
      const Eigen::Index at = 3 * static_cast<Eigen::Index>(part.tip);
      out.tip_shift_m[p] = best.state.tip_m.segment<3>(at);
      for (Eigen::Index k = 0; k < 3; ++k)
        out.tip_sigma_m[p][k] = std::sqrt(std::max(0.0, tip_covariance_m2(tips_at + at + k, at + k)));
    }
    if (!problem.slow() || !part.is_slow) continue;
    for (std::size_t i = 0; i < part.points; ++i) {
      out.slow_error_world_m[p].push_back(registration::slow_error_m(chain, best.state, part.first_point + i));
    }
  }
}

}  // namespace

RefinedPlacements refine_placements(std::span<const MeasuredPath> paths, std::span<const std::size_t> placement_of,
                                    const MeshSurface& surface, std::span<const RegistrationResult> starts,
                                    std::span<const std::optional<Pose>> guesses, const RefineConfig& given,
                                    const RegistrationObserver& observer) {
  IterationWatch watch(observer);
  watch.begin(RegistrationPhase::kRefinement);
  RefinedPlacements out;
  out.registrations.assign(starts.begin(), starts.end());
  out.slow_error_world_m.resize(paths.size());
  out.tip_shift_m.assign(paths.size(), Eigen::Vector3d::Zero());
  out.tip_sigma_m.assign(paths.size(), Eigen::Vector3d::Zero());
  for (std::size_t p = 0; p < paths.size(); ++p) {
    if (paths[p].q_world_marker.size() == paths[p].p_world_m.size()) out.tip_sigma_m[p] = paths[p].tip_sigma_m;
  }
  out.rms_m.assign(paths.size(), std::numeric_limits<double>::quiet_NaN());
  if (!given.enabled) return out;
  Problems ignored;  // refine_registration has reported it
  const RefineConfig config = registration::with_few_knots(paths, given, ignored);
  const PathChain chain = registration::make_chain(paths, config.knot_m, placement_of);
  if (!(chain.spacing_m > 0.0)) return out;
  std::vector<PosePrior> priors = priors_of(starts, guesses);
  Refinement problem(chain, surface, priors, config);
  std::vector<Pose> poses;
  for (const RegistrationResult& start : starts) poses.push_back(start.T_mesh_world);
  Refined best;
  best.state = registration::zero_state(chain, std::move(poses));
  best.heights = problem.heights(best.state);
  if (best.heights.count < registration::kLeastPoints) return out;
  int iterations = 0;
  for (int round = 0; round < kJointRounds; ++round) {
    const std::vector<Whitening> whitening = registration::learn_whitenings(chain, best.heights, config);
    if (!registration::has_variance(whitening)) return out;
    // Where strokes meet is known once the poses are.
    if (round > 0 && config.overlap_m > 0.0) {
      std::vector<OverlapLink> links = registration::find_overlaps(chain, best.heights, config.overlap_m);
      out.shifts = static_cast<std::size_t>(
          std::count_if(links.begin(), links.end(), [](const OverlapLink& link) { return link.along; }));
      out.crossings = links.size() - out.shifts;
      problem.set_overlaps(std::move(links));
    }
    best = descend_to_minimum(problem, best.state, whitening, config.max_iterations, watch);
    iterations += best.iterations;
    if (round + 1 < kJointRounds || !shows_facets(problem, best)) continue;
    best = descend_to_minimum(problem, best.state, whitening, config.max_iterations, watch, FacetKinks::kCounted);
    iterations += best.iterations;
  }
  if (!std::isfinite(best.cost) || best.information.rows() == 0) return out;

  for (std::size_t k = 0; k < starts.size(); ++k) {
    RegistrationResult& result = out.registrations[k];
    const Eigen::Index at = 6 * static_cast<Eigen::Index>(k);
    result.covariance = registration::inverse_columns(best.information, at, 6).middleRows<6>(at) +
                        registration::held_covariance(priors[k].held, config.guess_sigma_m);
    result.T_mesh_world = best.state.T_mesh_world[k];
    result.rms_m = rms_of(chain, best.heights, k);
    result.iterations += iterations;
    const PathChain own = registration::make_chain(members_of(paths, placement_of, k), config.knot_m);
    registration::append_uncertain_rotations(own, config.undetermined_deg * std::numbers::pi / 180.0, result);
  }
  read_paths(chain, problem, best, out);
  return out;
}

}  // namespace asperity
