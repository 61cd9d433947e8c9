#include <cmath>
#include <map>
#include <numbers>

#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/pipeline/write_registration.h"
#include "asperity/verdict/verdict_json.h"
#include "json.h"
#include "scan_names.h"

namespace asperity {

namespace {

Json undetermined_json(const RegistrationResult& registration) {
  Json out = Json::array();
  for (const UndeterminedMotion& motion : registration.undetermined) {
    out.push_back({{"description", motion.description},
                   {"sigma_m", number_or_null(motion.sigma_m)},
                   {"turn_rad", vector_json(motion.rotation_rad)},
                   {"shift_m", vector_json(motion.shift_m)},
                   {"centre_mesh_m", vector_json(motion.centre_mesh_m)}});
  }
  return out;
}

Json runner_up_json(const RegistrationResult& registration) {
  if (!registration.runner_up) return nullptr;
  const RunnerUp& other = *registration.runner_up;
  return {{"T_mesh_world", pose_json(other.T_mesh_world)},
          {"rms_m", other.rms_m},
          {"distance_m", other.distance_m},
          {"turn_deg", other.rotation_rad * 180.0 / std::numbers::pi}};
}

Json covariance_json(const RegistrationResult& registration) {
  Json out = Json::array();
  for (int row = 0; row < 6; ++row) {
    Json line = Json::array();
    for (int column = 0; column < 6; ++column) line.push_back(number_or_null(registration.covariance(row, column)));
    out.push_back(line);
  }
  return out;
}

Json warp_json(const HapticWarp& warp) {
  return {{"triangles", warp.triangles},
          {"stretch_min", number_or_null(warp.stretch_min)},
          {"stretch_max", number_or_null(warp.stretch_max)},
          {"stretch_rms", number_or_null(warp.stretch_rms)},
          {"folded", warp.folded.size()},
          {"stretched", warp.stretched.size()},
          {"overlapping", warp.overlapping.size()},
          {"along_rms_m", number_or_null(warp.along_rms_m)},
          {"along_max_m", number_or_null(warp.along_max_m)},
          {"across_rms_m", number_or_null(warp.across_rms_m)},
          {"length_ratio", number_or_null(warp.length_ratio)}};
}

// Of the pose that the scan shares with those of its placement, and of what was measured along it.
Verdicts verdicts_of(const ScansOnMesh& result, const RegisteredScan& scan) {
  Verdicts out = result.placements[scan.placement].verdicts;
  out.insert(out.end(), scan.process.verdicts.begin(), scan.process.verdicts.end());
  sort_verdicts(out);
  return out;
}

Json pose_with_error_json(const RegistrationResult& registration) {
  Json out;
  out["T_mesh_world"] = pose_json(registration.T_mesh_world);
  out["rms_m"] = number_or_null(registration.rms_m);
  out["covariance"] = {{"of", "turn about centre_mesh_m (rad), then shift (m)"},
                       {"centre_mesh_m", vector_json(registration.centre_mesh_m)},
                       {"matrix", covariance_json(registration)}};
  return out;
}

// The object's size over the mesh's, as the scans show it.
Json mesh_scale_json(const RegistrationResult& registration) {
  const MeshScale& scale = registration.rivals.scale;
  if (!std::isfinite(scale.ratio)) return nullptr;
  return {{"ratio", scale.ratio}, {"sigma", number_or_null(scale.ratio * scale.sigma)}, {"gain", scale.gain}};
}

Json placement_json(const ScansOnMesh& result, const Placement& placement) {
  const RegistrationResult& registration = placement.registration;
  Json out = pose_with_error_json(registration);
  out["scans"] = Json::array();
  for (const std::size_t i : placement.scans) out["scans"].push_back(result.scans[i].name);
  out["mean_m"] = number_or_null(registration.mean_m);
  out["converged"] = registration.converged;
  out["points"] = registration.points;
  out["outliers"] = registration.outliers;
  out["undetermined"] = undetermined_json(registration);
  out["runner_up"] = runner_up_json(registration);
  out["mesh_scale"] = mesh_scale_json(registration);
  out["verdict"] = verdict_word(placement.verdicts);
  out["verdicts"] = verdicts_json(placement.verdicts);
  return out;
}

Json scan_json(const ScansOnMesh& result, const RegisteredScan& scan, const ScanPlace& place,
               const std::vector<std::string>& files, const HapticWarp* warp) {
  Json out = pose_with_error_json(result.registration_of(scan));
  const Verdicts verdicts = verdicts_of(result, scan);
  out["name"] = scan.name;
  out["rms_m"] = number_or_null(scan.rms_m);
  if (scan.tip_sigma_m) {
    out["tip"] = {{"shift_m", vector_json(scan.tip_shift_m)}, {"sigma_m", vector_json(*scan.tip_sigma_m)}};
  }
  out["placement"] = place.placement;
  out["verdict"] = verdict_word(verdicts);
  out["verdicts"] = verdicts_json(verdicts);
  out["texture"] = place.texture;
  out["order"] = place.order;
  out["length_m"] = scan.path.s_m.empty() ? 0.0 : scan.path.s_m.back() - scan.path.s_m.front();
  out["points"] = scan.path.size();
  if (scan.path_texture) {
    const FourierSamplesFit& fit = scan.path_texture->series.fit;
    out["own_texture"] = {{"start_m", scan.path_texture->start_m},
                          {"length_mm", fit.texture.length_mm},
                          {"harmonics", fit.texture.a_m.size()},
                          {"rms_height_m", fit.rms_height_m},
                          {"rms_error_m", fit.rms_error_m}};
  }
  out["base_rms_m"] = scan.process.base.base_rms_m;
  if (warp != nullptr) out["warp"] = warp_json(*warp);
  out["fingerprint"] = fingerprint_json(scan.fingerprint);
  out["problems"] = problems_json(scan.process.problems);
  out["files"] = files;
  return out;
}

Json coordinates_json(const HapticCoordinates& coordinates) {
  Json out;
  std::size_t textured = 0;
  for (const HapticTriangle& triangle : coordinates.triangles) textured += triangle.texture >= 0 ? 1 : 0;
  out["triangles"] = textured;
  out["contested"] = coordinates.contested;
  out["warps"] = Json::array();
  for (const HapticWarp& warp : coordinates.warps) out["warps"].push_back(warp_json(warp));
  return out;
}

}  // namespace

Json registration_json(const ScansOnMesh& result, const std::vector<ScanPlace>& places,
                       const std::vector<std::vector<std::string>>& files, const EarlierScene& earlier) {
  const RegistrationResult& registration = result.placements.front().registration;
  Json out;
  out["format"] = "asperity-registration";
  out["version"] = 1;
  out["T_mesh_world"] = pose_json(registration.T_mesh_world);
  out["rms_m"] = number_or_null(registration.rms_m);
  out["mean_m"] = number_or_null(registration.mean_m);
  out["converged"] = registration.converged;
  out["stopped_by"] = kStopRuleNames.at(static_cast<std::size_t>(registration.stopped_by));
  out["iterations"] = registration.iterations;
  out["points"] = registration.points;
  out["outliers"] = registration.outliers;
  out["undetermined"] = undetermined_json(registration);
  out["runner_up"] = runner_up_json(registration);
  out["mesh_scale"] = mesh_scale_json(registration);
  out["trustworthy"] = result.trustworthy;
  out["verdict"] = result.verdict.empty() ? registration.verdict : result.verdict;
  out["verdicts"] = verdicts_json(result.verdicts);
  out["covariance"] = pose_with_error_json(registration).at("covariance");
  out["placements"] = stored_placements(earlier, names_of(result));
  for (const Placement& placement : result.placements) out["placements"].push_back(placement_json(result, placement));
  out["bulge"] = {{"share", number_or_null(result.bulge_share)}, {"sigma", number_or_null(result.bulge_sigma)}};
  out["overlaps"] = {{"crossings", result.crossings}, {"shifts", result.matched_shifts}};
  out["lines"] = lines_json(result.lines);
  out["registered"] = names_of(result);
  std::map<int, Json> scans = stored_scans(earlier);
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    const HapticWarp* warp = i < result.coordinates.warps.size() ? &result.coordinates.warps[i] : nullptr;
    scans[places[i].texture] = scan_json(result, result.scans[i], places[i], files[i], warp);
  }
  out["scans"] = Json::array();
  for (auto& [index, scan] : scans) {
    if (scan.value("verdict", "") == "invalid") out["trustworthy"] = false;
    out["scans"].push_back(std::move(scan));
  }
  out["coordinates"] = coordinates_json(result.coordinates);
  out["problems"] = problems_json(result.problems);
  out["files"] = Json::array();
  RegisterConfig config = result.config;
  out["config"] = config_json(list_fields("", config));
  out["asperity"] = kVersion;
  return out;
}

}  // namespace asperity
