#include "asperity/pipeline/find_placements.h"

#include <algorithm>
#include <utility>

#include "asperity/pipeline/pose_candidates.h"
#include "asperity/registration/find_registration.h"
#include "asperity/registration/placement_likelihood.h"
#include "asperity/registration/register_path.h"

namespace asperity {

namespace {

struct Group {
  std::vector<std::size_t> scans;
  PlacementFit fit;
};

// The likelier poses of a scan alone.
std::vector<Pose> likely_poses(const std::vector<WeighedPose>& found) {
  constexpr double kHopeless = 30.0;  // logarithm of the odds
  constexpr std::size_t kMost = 8;
  std::vector<Pose> out;
  for (const WeighedPose& pose : found) {
    if (out.size() < kMost && pose.log_mass > found.front().log_mass - kHopeless) out.push_back(pose.T_mesh_world);
  }
  return out;
}

// A scan that stayed alone joins a placement that later scans have shown better, if it belongs there.
void unite_singles(const ScanPoints& scans, const RegistrationSurface& ready, const WeighConfig& weighing,
                   const RegistrationConfig& search, std::vector<Group>& groups) {
  for (std::size_t g = groups.size(); g-- > 0;) {
    if (groups[g].scans.size() > 1) continue;
    std::size_t best = groups.size();
    double best_odds = 0.0;
    PlacementFit best_fit;
    for (std::size_t h = 0; h < groups.size(); ++h) {
      if (h == g) continue;
      std::vector<MeasuredPath> paths;
      for (const std::size_t k : groups[h].scans) paths.push_back(scans.points[k].path);
      paths.push_back(scans.points[groups[g].scans.front()].path);
      const std::vector<Pose> starts{groups[h].fit.T_mesh_world};
      const PlacementFit together = fit_placement(paths, ready, starts, weighing, search);
      const double odds = together.log_evidence - groups[h].fit.log_evidence - groups[g].fit.log_evidence;
      if (!(odds > best_odds)) continue;
      best = h;
      best_odds = odds;
      best_fit = together;
    }
    if (best == groups.size()) continue;
    std::vector<std::size_t>& members = groups[best].scans;
    members.insert(std::upper_bound(members.begin(), members.end(), groups[g].scans.front()), groups[g].scans.front());
    groups[best].fit = best_fit;
    groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(g));
  }
  // In the order of their first scans.
  std::sort(groups.begin(), groups.end(),
            [](const Group& a, const Group& b) { return a.scans.front() < b.scans.front(); });
}

}  // namespace

FoundPlacements find_placements(const ScanPoints& scans, const RegistrationSurface& ready,
                                const std::optional<Pose>& guess, const RegisterConfig& config,
                                const RegistrationObserver& observer) {
  RegisterConfig searched = config;
  searched.search.registration.error_length_m = config.refinement.slow_length_m;
  const RegistrationConfig& search = searched.search.registration;
  const WeighConfig weighing = weigh_config(scans, {}, config.refinement);
  std::vector<Group> groups;
  for (std::size_t i = 0; i < scans.points.size(); ++i) {
    observer.update("placements", static_cast<double>(i) / static_cast<double>(scans.points.size()));
    ScanPoints one;
    one.in_sequence = scans.in_sequence;
    one.points.push_back(scans.points[i]);
    std::vector<Pose> near;
    if (guess) {
      const std::vector<MeasuredPath> smooth{smooth_path(scans.points[i].path, config.points.smoothing_m)};
      near.push_back(register_path(smooth, ready, *guess, search).T_mesh_world);
    }
    const PoseCandidates candidates = find_pose_candidates(one, ready, {}, near, searched);
    const PlacementFit alone = best_placement(candidates.found, ready);

    std::size_t best = groups.size();
    double best_odds = 0.0;  // logarithm; a placement of its own has 0
    PlacementFit best_fit;
    const auto members = [&](std::size_t g) {
      std::vector<MeasuredPath> out;
      for (const std::size_t k : groups[g].scans) out.push_back(scans.points[k].path);
      out.push_back(scans.points[i].path);
      return out;
    };
    const auto try_group = [&](std::size_t g, std::span<const Pose> starts) {
      const PlacementFit together = fit_placement(members(g), ready, starts, weighing, search);
      const double odds = together.log_evidence - groups[g].fit.log_evidence - alone.log_evidence;
      if (!(odds > best_odds)) return;
      best = g;
      best_odds = odds;
      best_fit = together;
    };
    for (std::size_t g = 0; g < groups.size(); ++g) try_group(g, std::vector<Pose>{groups[g].fit.T_mesh_world});
    // The placement's pose may be a wrong one as long as few scans have shown it.
    const std::vector<Pose> likely = likely_poses(candidates.found);
    const bool none = best == groups.size();
    for (std::size_t g = 0; g < groups.size() && none; ++g) try_group(g, likely);
    // Two scans may each be at home elsewhere: a short stroke fits in many places. Together they fit in fewer.
    for (std::size_t g = 0; g < groups.size() && best == groups.size(); ++g) {
      if (groups[g].scans.size() > 1) continue;
      std::vector<MeasuredPath> smooth = members(g);
      for (MeasuredPath& path : smooth) path = smooth_path(path, config.points.smoothing_m);
      try_group(g, find_poses(smooth, ready, searched.search));
    }
    if (best == groups.size()) {
      groups.push_back({{i}, alone});
    } else {
      groups[best].scans.push_back(i);
      groups[best].fit = best_fit;
    }
  }
  unite_singles(scans, ready, weighing, search, groups);
  FoundPlacements out;
  for (Group& group : groups) {
    out.groups.push_back(std::move(group.scans));
    out.poses.push_back(group.fit.T_mesh_world);
  }
  return out;
}

}  // namespace asperity
