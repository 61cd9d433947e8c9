#include "asperity/pipeline/find_placements.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "asperity/registration/find_registration.h"
#include "asperity/registration/placement_likelihood.h"
#include "asperity/registration/register_path.h"

namespace asperity {

namespace {

struct Group {
  std::vector<std::size_t> scans;
  PlacementFit fit;
  double points = 0.0;
};

// Points that one correlation length of the relief holds count once.
double independent_points(double points, const RegisterConfig& config) {
  return points * std::min(1.0, config.points.spacing_m / config.refinement.memory_m);
}

}  // namespace

FoundPlacements find_placements(std::span<const MeasuredPath> paths, std::span<const MeasuredPath> smooth,
                                const MeshSurface& surface, const RegistrationSurface& ready,
                                const std::optional<Pose>& guess, const RegisterConfig& config,
                                const RegistrationObserver& observer) {
  SearchConfig search = config.search;
  search.registration.error_length_m = config.refinement.slow_length_m;
  PlacementLikelihood likelihood(paths, surface, config.refinement);
  std::vector<PlacementFit> alone;
  std::vector<std::vector<Pose>> places(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    observer.update("placements", static_cast<double>(i) / static_cast<double>(paths.size()));
    const std::span<const MeasuredPath> one = smooth.subspan(i, 1);
    if (guess) places[i].push_back(register_path(one, ready, *guess, search.registration).T_mesh_world);
    const RegistrationResult anywhere = find_registration(one, ready, search);
    places[i].push_back(anywhere.T_mesh_world);
    if (anywhere.runner_up) places[i].push_back(anywhere.runner_up->T_mesh_world);
    alone.push_back(likelihood.learn(i, places[i]));
  }

  std::vector<Group> groups;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::size_t best = groups.size();
    PlacementFit best_fit;
    double best_excess = std::numeric_limits<double>::infinity();
    const auto try_group = [&](std::size_t g, std::span<const Pose> starts) {
      std::vector<std::size_t> members = groups[g].scans;
      members.push_back(i);
      const PlacementFit together = likelihood.fit(members, starts);
      const double excess = together.cost - groups[g].fit.cost - alone[i].cost;
      const double threshold =
          placement_threshold(independent_points(groups[g].points + static_cast<double>(likelihood.points(i)), config));
      if (!(excess < threshold) || !(excess < best_excess)) return;
      best = g;
      best_excess = excess;
      best_fit = together;
    };
    for (std::size_t g = 0; g < groups.size(); ++g) {
      std::vector<Pose> starts{groups[g].fit.T_mesh_world};
      starts.insert(starts.end(), places[i].begin(), places[i].end());
      if (guess) starts.push_back(*guess);
      try_group(g, starts);
    }
    // Each alone may be at home elsewhere: a short stroke fits in many places. Together they fit in fewer.
    for (std::size_t g = 0; g < groups.size() && best == groups.size(); ++g) {
      std::vector<MeasuredPath> together;
      for (const std::size_t k : groups[g].scans) together.push_back(smooth[k]);
      together.push_back(smooth[i]);
      const RegistrationResult anywhere = find_registration(together, ready, search);
      std::vector<Pose> starts{anywhere.T_mesh_world};
      if (anywhere.runner_up) starts.push_back(anywhere.runner_up->T_mesh_world);
      try_group(g, starts);
    }
    const auto points = static_cast<double>(likelihood.points(i));
    if (best == groups.size()) {
      groups.push_back({{i}, alone[i], points});
    } else {
      groups[best].scans.push_back(i);
      groups[best].fit = best_fit;
      groups[best].points += points;
    }
  }
  FoundPlacements out;
  for (Group& group : groups) {
    out.groups.push_back(std::move(group.scans));
    out.poses.push_back(group.fit.T_mesh_world);
  }
  return out;
}

}  // namespace asperity
