#include "merge_scans.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "asperity/base/text.h"
#include "asperity/verdict/judge_passes.h"
#include "repeated_lines.h"

namespace asperity {

namespace {

std::vector<Eigen::Vector3d> path_on_mesh(const RegisteredScan& scan, const Pose& T_mesh_world) {
  std::vector<Eigen::Vector3d> out = points_under_profile(scan.process.base.path, scan.process.measured_profile);
  for (Eigen::Vector3d& p_m : out) p_m = T_mesh_world * p_m;
  return out;
}

}  // namespace

std::vector<std::size_t> merge_scans(const std::vector<Scan>& scans, const RegisterConfig& config,
                                     ScansOnMesh& result) {
  std::vector<std::vector<Eigen::Vector3d>> paths(scans.size());
  std::vector<MeasuredProfile> measured(scans.size());
  std::vector<MeasuredProfile*> all;
  std::vector<std::string> names;
  double spacing_m = 0.0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const RegisteredScan& scan = result.scans[i];
    all.push_back(&measured[i]);
    names.push_back(printable(scan.name, 200));
    if (!scans[i].recording || scan.process.measured_profile.size() < 2) continue;
    measured[i].profile = scan.process.measured_profile;
    measured[i].measured_texture_m = measured[i].profile.texture_m;
    measured[i].noise = scan.process.measured_noise;
    measured[i].speed = scan.process.speed;
    spacing_m = measured[i].profile.spacing_m;
    paths[i] = path_on_mesh(scan, result.registration_of(scan).T_mesh_world);
  }
  std::set<std::size_t> changed;
  for (const SharedLine& line : find_shared_lines(paths, spacing_m > 0.0 ? spacing_m : 25e-6)) {
    RepeatedLine merged = merge_line(line, all, names);
    if (merged.merged.passes.empty()) continue;
    if (merged.laid) {
      for (const LinePass& part : line) changed.insert(part.scan);
    }
    if (merged.one_line) {
      judge_passes({merged.merged.noise_ratio, merged.merged.noise_ratio_low, merged.merged.noise_ratio_high},
                   result.verdicts);
    }
    result.lines.push_back(std::move(merged));
  }
  for (const std::size_t i : changed)
    measure_again(*scans[i].recording, config.process, std::move(measured[i]), result.scans[i].process);
  return {changed.begin(), changed.end()};
}

}  // namespace asperity
