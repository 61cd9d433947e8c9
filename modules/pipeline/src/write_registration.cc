#include "asperity/pipeline/write_registration.h"

#include <algorithm>
#include <cmath>
#include <map>
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
#include "asperity/scene/scan_materials.h"
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

// The files that a registration.json lists, and itself; empty if it is not one of ours.
std::set<std::string> listed_files(const fs::path& file) {
  constexpr std::uint64_t kLargest_bytes = 64 << 20;
  const Json json = parse_json_or_null(read_file(file, kLargest_bytes));
  if (!json.is_object() || json.value("format", "") != "asperity-registration") return {};
  std::set<std::string> out{"registration.json"};
  for (const Json& name : json.at("files")) out.insert(name.get<std::string>());
  return out;
}

// The textures of this call, with what is known of where they came from.
std::vector<SceneTexture> textures_of(const ScansOnMesh& result, const std::vector<ScanPlace>& places,
                                      const std::vector<Scan>& scans, const std::string& date) {
  RegisterConfig config = result.config, usual;
  const Json settings = changed_settings(list_fields("", config), list_fields("", usual));
  std::vector<SceneTexture> out;
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    if (!result.scans[i].texture) continue;
    TextureOrigin origin;
    origin.kind = kScanOrigin;
    const std::string& name = result.scans[i].name;
    origin.name = is_utf8(name) ? name : printable(name, 1000);
    if (i < scans.size()) origin.checksum = scans[i].checksum;
    origin.T_mesh_world = result.registration_of(result.scans[i]).T_mesh_world;
    origin.placement = places[i].placement;
    origin.date = date;
    origin.version = kVersion;
    origin.settings = settings;
    out.push_back({places[i].texture, places[i].file, *result.scans[i].texture, places[i].order, std::move(origin)});
  }
  return out;
}

// The coordinates of this call by the scene's indices.
std::vector<CoveredTriangle> claims_of(const HapticCoordinates& coordinates, const std::vector<ScanPlace>& places) {
  std::vector<CoveredTriangle> out;
  const auto add = [&](std::uint32_t triangle, HapticTriangle haptic) {
    if (haptic.texture < 1) return;
    const auto scan = static_cast<std::size_t>(haptic.texture - 1);
    haptic.texture = places[scan].texture;
    out.push_back({triangle, haptic});
  };
  auto covered = coordinates.covered.begin();
  for (std::uint32_t t = 0; t < coordinates.triangles.size(); ++t) {
    for (; covered != coordinates.covered.end() && covered->triangle == t; ++covered) add(t, covered->haptic);
    add(t, coordinates.triangles[t]);
  }
  return out;
}

std::vector<std::string> files_below(const fs::path& folder, const fs::path& root) {
  std::vector<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) out.push_back(fs::relative(entry.path(), root).generic_string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::string> names_of(const ScansOnMesh& result) {
  std::vector<std::string> out;
  for (const RegisteredScan& scan : result.scans) out.push_back(scan.name);
  return out;
}

// The places with the placements of this call, numbered on from those that the scene has.
std::vector<ScanPlace> places_of(const EarlierScene& earlier, const ScansOnMesh& result) {
  std::vector<ScanPlace> out = place_scans(earlier, names_of(result));
  const auto stored = static_cast<int>(stored_placements(earlier, names_of(result)).size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i].placement = stored + static_cast<int>(result.scans[i].placement) + 1;
  return out;
}

// A scan's path on the mesh, mesh frame.
std::string format_path_csv(const MeshPath& path) {
  std::string out = "s_m,px_m,py_m,pz_m,triangle\n";
  for (std::size_t i = 0; i < path.size(); ++i) {
    append_number(out, path.s_m[i]);
    for (const double p : path.p_mesh_m[i]) {
      out += ',';
      append_number(out, p);
    }
    out += ',' + std::to_string(path.triangle[i]) + '\n';
  }
  return out;
}

}  // namespace

void add_scans(Scene& scene, const ScansOnMesh& result, const std::vector<ScanPlace>& places,
               const std::vector<Scan>& scans, const std::string& date) {
  SceneObject& object = scene.objects.front();
  const bool measured = is_of_scans(object);
  for (const ScanPlace& place : places) {
    if (place.replaces) take_out_texture(object, place.texture);
  }
  for (SceneTexture& texture : textures_of(result, places, scans, date)) put_texture(object, std::move(texture));
  lay_triangles(object, claims_of(result.coordinates, places));
  if (measured) set_scan_materials(object, free_file_name(scene, "material.csv"));
  const std::vector<const SceneTexture*> all = scans_of(scene);
  scene.T_mesh_world =
      all.empty() ? result.placements.front().registration.T_mesh_world : all.front()->origin->T_mesh_world;
}

Scene make_scene(const ScansOnMesh& result, const MeshFile& mesh, double unit_m) {
  EarlierScene earlier = scene_of_mesh(mesh, unit_m);
  add_scans(earlier.scene, result, places_of(earlier, result), {}, {});
  return std::move(earlier.scene);
}

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
                        EarlierScene earlier, bool listing) {
  const std::vector<ScanPlace> places = places_of(earlier, result);
  std::set<std::string> dropped;
  std::vector<std::vector<std::string>> files;
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    const RegisteredScan& scan = result.scans[i];
    if (places[i].replaces) dropped.merge(files_of_scan(earlier, scan.name));
    const fs::path place = folder / places[i].folder;
    fs::create_directories(place);
    if (scan.is_recording) {
      write_result(place, scan.process, *scans[i].recording, scan.name);
    } else if (scan.process.profile.size() > 0) {
      write_file(place / "profile.csv", format_profile_csv(scan.process.profile));
      write_file(place / "spectrum.csv", format_spectrum_csv(scan.process.spectrum));
    }
    if (scan.path.size() > 0) write_file(place / "path.csv", format_path_csv(scan.path));
    files.push_back(files_below(place, folder));
  }
  earlier.registration = registration_json(result, places, files, earlier);
  add_scans(earlier.scene, result, places, scans, earlier.date);
  write_scene_again(folder, earlier, dropped, listing);
}

void write_registration(const fs::path& folder, const ScansOnMesh& result, const std::vector<Scan>& scans,
                        const MeshFile& mesh, double unit_m) {
  write_registration(folder, result, scans, scene_of_mesh(mesh, unit_m));
}

}  // namespace asperity
