#include "asperity/pipeline/write_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/json/parse_json.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/write_scene.h"
#include "asperity/verdict/verdict_json.h"
#include "json.h"

namespace asperity {

namespace fs = std::filesystem;

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
  out["verdict"] = verdict_word(placement.verdicts);
  out["verdicts"] = verdicts_json(placement.verdicts);
  return out;
}

Json scan_json(const ScansOnMesh& result, std::size_t index) {
  const RegisteredScan& scan = result.scans[index - 1];
  Json out = pose_with_error_json(result.registration_of(scan));
  const Verdicts verdicts = verdicts_of(result, scan);
  out["name"] = scan.name;
  out["rms_m"] = number_or_null(scan.rms_m);
  if (scan.tip_sigma_m) {
    out["tip"] = {{"shift_m", vector_json(scan.tip_shift_m)}, {"sigma_m", vector_json(*scan.tip_sigma_m)}};
  }
  out["placement"] = scan.placement + 1;
  out["verdict"] = verdict_word(verdicts);
  out["verdicts"] = verdicts_json(verdicts);
  out["texture"] = index;
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
  out["problems"] = problems_json(scan.process.problems);
  return out;
}

Json coordinates_json(const HapticCoordinates& coordinates) {
  Json out;
  std::size_t textured = 0;
  for (const HapticTriangle& triangle : coordinates.triangles) textured += triangle.texture >= 0 ? 1 : 0;
  out["triangles"] = textured;
  out["contested"] = coordinates.contested;
  out["warps"] = Json::array();
  for (const HapticWarp& warp : coordinates.warps) {
    out["warps"].push_back({{"triangles", warp.triangles},
                            {"stretch_min", number_or_null(warp.stretch_min)},
                            {"stretch_max", number_or_null(warp.stretch_max)},
                            {"stretch_rms", number_or_null(warp.stretch_rms)},
                            {"folded", warp.folded.size()},
                            {"stretched", warp.stretched.size()},
                            {"overlapping", warp.overlapping.size()},
                            {"along_rms_m", number_or_null(warp.along_rms_m)},
                            {"along_max_m", number_or_null(warp.along_max_m)},
                            {"across_rms_m", number_or_null(warp.across_rms_m)},
                            {"length_ratio", number_or_null(warp.length_ratio)}});
  }
  return out;
}

// The files that a registration.json lists, and itself; empty if it is not one of ours.
std::set<std::string> listed_files(const fs::path& file) {
  constexpr std::uint64_t kLargest_bytes = 64 << 20;
  const Json json = parse_json_or_null(read_file(file, kLargest_bytes));
  if (!json.is_object() || json.value("format", "") != "asperity-registration") return {};
  std::set<std::string> out{"registration.json"};
  for (const Json& name : json.at("files")) out.insert(name.get<std::string>());
  return out;
}

Material material_of(const Texture& texture) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return {texture.compliance_kc.value_or(kUnknown), texture.stiffness_N_per_m.value_or(kUnknown),
          texture.friction.value_or(kUnknown)};
}

bool is_known(const Material& material) {
  return std::isfinite(material.compliance_kc) || std::isfinite(material.stiffness_N_per_m) ||
         std::isfinite(material.friction);
}

}  // namespace

Scene make_scene(const ScansOnMesh& result, const MeshFile& mesh, double unit_m) {
  SceneObject object;
  object.mesh_file = "textured.obj";
  object.unit_m = unit_m;
  object.mesh = mesh;
  object.mesh.haptic = result.coordinates.triangles;
  std::vector<int> textures;
  std::vector<Material> materials;
  bool any = false;
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    if (!result.scans[i].texture) continue;
    const int index = static_cast<int>(i) + 1;
    object.textures.push_back({index, "scan" + std::to_string(index) + ".texture.json", *result.scans[i].texture});
    textures.push_back(index);
    materials.push_back(material_of(*result.scans[i].texture));
    any = any || is_known(materials.back());
  }
  if (any) {
    object.material = spread_materials(mesh.vertices.size(), mesh.triangles, object.mesh.haptic, textures, materials);
    object.material_file = "material.csv";
  }
  Scene scene;
  scene.objects.push_back(std::move(object));
  scene.T_mesh_world = result.placements.front().registration.T_mesh_world;
  return scene;
}

std::string format_registration(const ScansOnMesh& result, std::span<const std::string> files) {
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
  out["trustworthy"] = result.trustworthy;
  out["verdict"] = result.verdict.empty() ? registration.verdict : result.verdict;
  out["verdicts"] = verdicts_json(result.verdicts);
  out["covariance"] = pose_with_error_json(registration).at("covariance");
  out["placements"] = Json::array();
  for (const Placement& placement : result.placements) out["placements"].push_back(placement_json(result, placement));
  out["bulge"] = {{"share", number_or_null(result.bulge_share)}, {"sigma", number_or_null(result.bulge_sigma)}};
  out["overlaps"] = {{"crossings", result.crossings}, {"shifts", result.matched_shifts}};
  out["scans"] = Json::array();
  for (std::size_t i = 0; i < result.scans.size(); ++i) out["scans"].push_back(scan_json(result, i + 1));
  out["coordinates"] = coordinates_json(result.coordinates);
  out["problems"] = problems_json(result.problems);
  out["files"] = files;
  RegisterConfig config = result.config;
  out["config"] = config_json(list_fields("", config));
  out["asperity"] = kVersion;
  // Names come from files; what is not UTF-8 in them must not stop the writing.
  return out.dump_repaired(2) + "\n";
}

bool is_registration_folder(const fs::path& folder) noexcept {
  try {
    const fs::path file = folder / "registration.json";
    if (!fs::is_regular_file(file)) return false;
    const std::set<std::string> ours = listed_files(file);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_directory() || entry.path().filename() == "report.html") continue;
      if (!ours.contains(fs::relative(entry.path(), folder).generic_string())) return false;
    }
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

void write_registration(const fs::path& folder, const ScansOnMesh& result, const std::vector<Scan>& scans,
                        const MeshFile& mesh, double unit_m) {
  for (const RegisteredScan& scan : result.scans) {
    const bool one_name = stays_inside(scan.name) && !fs::path(scan.name).has_parent_path();
    if (result.scans.size() > 1 && !one_name)
      throw Error("registration: '" + printable(scan.name) + "' cannot be the name of a scan's folder");
  }
  write_scene(folder / "scene.json", make_scene(result, mesh, unit_m));
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    const RegisteredScan& scan = result.scans[i];
    const fs::path place = result.scans.size() == 1 ? folder : folder / scan.name;
    fs::create_directories(place);
    if (scan.is_recording) {
      write_result(place, scan.process, *scans[i].recording, scan.name);
    } else if (scan.process.profile.size() > 0) {
      write_file(place / "profile.csv", format_profile_csv(scan.process.profile));
      write_file(place / "spectrum.csv", format_spectrum_csv(scan.process.spectrum));
    }
  }
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) files.push_back(fs::relative(entry.path(), folder).generic_string());
  }
  std::sort(files.begin(), files.end());
  write_file(folder / "registration.json", format_registration(result, files));
}

}  // namespace asperity
