#include "asperity/pipeline/write_registration.h"

#include <algorithm>
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
#include "asperity/recording/fingerprint.h"
#include "asperity/scene/scan_materials.h"
#include "scan_names.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

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
    origin.fingerprint = fingerprint_json(result.scans[i].fingerprint);
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

std::vector<CoveredTexture> add_scans(Scene& scene, const ScansOnMesh& result, const std::vector<ScanPlace>& places,
                                      const std::vector<Scan>& scans, const std::string& date) {
  SceneObject& object = scene.objects.front();
  const bool measured = is_of_scans(object);
  for (const ScanPlace& place : places) {
    if (place.replaces) take_out_texture(object, place.texture);
  }
  for (SceneTexture& texture : textures_of(result, places, scans, date)) put_texture(object, std::move(texture));
  std::vector<CoveredTexture> covered =
      covered_textures(object, lay_triangles(object, claims_of(result.coordinates, places)));
  // Scans of this call over one another are its own.
  std::erase_if(covered, [&](const CoveredTexture& texture) {
    return std::any_of(places.begin(), places.end(),
                       [&](const ScanPlace& place) { return place.texture == texture.index; });
  });
  if (measured) set_scan_materials(object, free_file_name(scene, "material.csv"));
  const std::vector<const SceneTexture*> all = scans_of(scene);
  scene.T_mesh_world =
      all.empty() ? result.placements.front().registration.T_mesh_world : all.front()->origin->T_mesh_world;
  return covered;
}

Scene make_scene(const ScansOnMesh& result, const MeshFile& mesh, double unit_m) {
  EarlierScene earlier = scene_of_mesh(mesh, unit_m);
  add_scans(earlier.scene, result, places_of(earlier, result), {}, {});
  return std::move(earlier.scene);
}

FolderContent is_registration_folder(const fs::path& folder) noexcept {
  try {
    const fs::path file = folder / "registration.json";
    if (!fs::is_regular_file(file)) return false;
    const std::set<std::string> ours = listed_files(file);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_directory() || entry.path().filename() == "report.html") continue;
      const fs::path name = fs::relative(entry.path(), folder);
      if (!ours.contains(name.generic_string()))
        return ours.empty() ? FolderContent(false) : FolderContent::with_added(name);
    }
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

std::vector<CoveredTexture> write_registration(const fs::path& folder, const ScansOnMesh& result,
                                               const std::vector<Scan>& scans, EarlierScene earlier, bool listing) {
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
  std::vector<CoveredTexture> covered = add_scans(earlier.scene, result, places, scans, earlier.date);
  write_scene_again(folder, earlier, dropped, listing);
  return covered;
}

void write_registration(const fs::path& folder, const ScansOnMesh& result, const std::vector<Scan>& scans,
                        const MeshFile& mesh, double unit_m) {
  write_registration(folder, result, scans, scene_of_mesh(mesh, unit_m));
}

}  // namespace asperity
