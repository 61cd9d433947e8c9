#include "align/residual_block.h"

#include <span>

#include "align/path_residuals.h"
#include "align/residual_sigma.h"
#include "align/scan_overlaps.h"

namespace asperity::studio {

BlockWriter residual_block(const AlignScene& scene, const Pose& pose, const std::vector<Pose>& poses,
                           std::vector<ClosestPoint>& closest) {
  std::vector<Eigen::Vector3d> moved_m;
  if (!poses.empty()) {
    const Pose back = pose.inverse();
    for (std::size_t i = 0; i < scene.p_world_m.size(); ++i)
      moved_m.push_back(back * (poses[scene.path[i]] * scene.p_world_m[i]));
  }
  const PathResiduals residuals =
      path_residuals(poses.empty() ? scene.p_world_m : moved_m, scene.surface, pose, closest);
  const std::vector<Pose> each = poses.empty() ? std::vector<Pose>(scene.of.paths.size(), pose) : poses;
  const ResidualSigma sigma = residual_sigma(scene, residuals, each);
  std::vector<std::uint8_t> overlap = poses.empty() ? scene.overlap : scan_overlaps(scene, poses);
  for (std::size_t i = 0; i < overlap.size(); ++i) {
    if (closest[i].found() && scene.occupied[closest[i].triangle] != 0) overlap[i] |= kOnTexture;
  }
  BlockWriter out("align.residuals");
  out.head()["mean_m"] = residuals.mean_m;
  out.head()["rms_m"] = residuals.rms_m;
  out.head()["most_m"] = residuals.most_m;
  out.head()["rms_sigma"] = number_or_null(sigma.rms);
  out.head()["median_sigma_m"] = number_or_null(sigma.median_m);
  out.head()["overlap_m"] = overlap_reach_m(scene);
  out.add("distance_m", std::span<const float>(residuals.distance_m));
  out.add("sigma_m", std::span<const float>(sigma.sigma_m));
  out.add("overlap", std::span<const std::uint8_t>(overlap));
  return out;
}

}  // namespace asperity::studio
