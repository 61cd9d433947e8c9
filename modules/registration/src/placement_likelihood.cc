#include "asperity/registration/placement_likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "descend.h"
#include "refine_settings.h"

namespace asperity {

using registration::PathChain;
using registration::Refined;
using registration::Refinement;
using registration::State;
using registration::Whitening;

struct PlacementLikelihood::Filters {
  std::vector<Whitening> of_path;
};

namespace {

Eigen::Vector3d middle_of(const PathChain& chain, const Pose& T_mesh_world) {
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const Eigen::Vector3d& p_m : chain.p_world_m) {
    if (!p_m.allFinite()) continue;
    sum_m += p_m;
    count += 1.0;
  }
  return T_mesh_world * Eigen::Vector3d(sum_m / std::max(1.0, count));
}

RefineConfig free_of_guesses(RefineConfig config) {
  // Steps along motions that the paths leave open stay bounded; the cost does not count it.
  config.guess_sigma_m = 20e-3;
  config.guess_sigma_deg = 20.0;
  return config;
}

// One descent; with `learns` the filters are made again at its end, and it goes on from there.
Refined descend(const PathChain& chain, const MeshSurface& surface, const Pose& start, const RefineConfig& config,
                std::vector<Whitening>& filters, bool learns) {
  const Refinement problem(chain, surface, {{start, middle_of(chain, start), {}}}, config);
  State state = registration::zero_state(chain, {start});
  const RegistrationObserver silent;
  registration::IterationWatch watch(silent);
  Refined out;
  for (int round = 0; round < (learns ? 2 : 1); ++round) {
    if (learns) filters = registration::learn_whitenings(chain, problem.heights(state), config);
    if (!registration::has_variance(filters)) return out;
    out = registration::descend_to_minimum(problem, state, filters, config.max_iterations, watch);
    out.cost = problem.likelihood_cost(out.state, out.heights, filters);
    state = out.state;
  }
  return out;
}

}  // namespace

PlacementLikelihood::PlacementLikelihood(std::span<const MeasuredPath> paths, const MeshSurface& surface,
                                         const RefineConfig& config)
    : paths_(paths), surface_(surface), filters_(std::make_shared<Filters>()) {
  Problems ignored;
  config_ = registration::with_few_knots(paths, free_of_guesses(config), ignored);
  filters_->of_path.resize(paths.size());
}

PlacementFit PlacementLikelihood::learn(std::size_t path, std::span<const Pose> starts) {
  const PathChain chain = registration::make_chain(paths_.subspan(path, 1), config_.knot_m);
  PlacementFit out{starts.empty() ? Pose{} : starts.front(), std::numeric_limits<double>::infinity()};
  double best = std::numeric_limits<double>::infinity();
  for (const Pose& start : starts) {
    std::vector<Whitening> filters;
    const Refined there = descend(chain, surface_, start, config_, filters, true);
    if (!std::isfinite(there.cost)) continue;
    // Filters differ from start to start: their own logarithm counts.
    const double cost = there.cost + static_cast<double>(points(path)) * std::log(filters.front().variance_m2);
    if (!(cost < best)) continue;
    best = cost;
    out = {there.state.T_mesh_world.front(), there.cost};
    filters_->of_path[path] = filters.front();
  }
  return out;
}

PlacementFit PlacementLikelihood::fit(std::span<const std::size_t> members, std::span<const Pose> starts) const {
  std::vector<MeasuredPath> paths;
  std::vector<Whitening> filters;
  for (const std::size_t p : members) {
    paths.push_back(paths_[p]);
    filters.push_back(filters_->of_path[p]);
  }
  const PathChain chain = registration::make_chain(paths, config_.knot_m);
  PlacementFit out{starts.empty() ? Pose{} : starts.front(), std::numeric_limits<double>::infinity()};
  for (const Pose& start : starts) {
    const Refined there = descend(chain, surface_, start, config_, filters, false);
    if (there.cost < out.cost) out = {there.state.T_mesh_world.front(), there.cost};
  }
  return out;
}

double placement_threshold(double independent_points) {
  constexpr double kNumbers = 6.0;
  constexpr double kLeast = 22.46;  // of χ² with 6 degrees of freedom: one in a thousand is above
  return std::max(kLeast, kNumbers * std::log(std::max(1.0, independent_points)));
}

}  // namespace asperity
