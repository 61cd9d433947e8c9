#include "asperity/pipeline/earlier_scene.h"

#include <algorithm>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/md5.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/scan_materials.h"
#include "asperity/scene/write_scene.h"
#include "json.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLargestListing_bytes = 64 << 20;
constexpr const char* kRegistration = "registration.json";
constexpr const char* kListingFile = "files.json";

void add_listed(const fs::path& file, const char* format, std::set<std::string>& out) {
  if (!fs::is_regular_file(file)) return;
  const Json json = parse_json_or_null(read_file(file, kLargestListing_bytes));
  if (!json.is_object() || json.value("format", "") != format) return;
  for (const Json& name : json.at("files")) out.insert(name.get<std::string>());
  out.insert(file.filename().string());
  out.insert("report.html");
}

std::vector<std::string> all_files(const fs::path& folder) {
  std::vector<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) out.push_back(fs::relative(entry.path(), folder).generic_string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

// The scan's member of registration.json; nullptr if it has none.
const Json* find_entry(const Json& registration, const std::string& name) {
  const Json* scans = registration.find("scans");
  if (scans == nullptr || !scans->is_array()) return nullptr;
  for (const Json& scan : *scans) {
    if (scan.is_object() && scan.value("name", "") == name) return &scan;
  }
  return nullptr;
}

// Scenes had no origins once; their registration.json had names and one pose. Throws Error for what is not one.
void add_origins(EarlierScene& earlier) {
  for (const Json& scan : earlier.registration.at("scans").list()) {
    const int index = scan.at("texture").get<int>();
    if (index < 0 || scan.at("name").text().empty()) throw Error("a scan without name or texture");
    for (SceneTexture& texture : earlier.object().textures) {
      if (texture.index != index || texture.origin) continue;
      TextureOrigin& origin = texture.origin.emplace();
      origin.kind = kScanOrigin;
      origin.name = scan.at("name").get<std::string>();
      origin.T_mesh_world = earlier.scene.T_mesh_world;
    }
  }
}

// The names of a scene's files as it was read.
std::set<std::string> files_of_scene(const Scene& scene, const std::string& file) {
  std::set<std::string> out{file};
  for (const SceneObject& object : scene.objects) {
    out.insert(object.mesh_file);
    out.insert(fs::path(object.mesh_file).replace_extension(".mtl").string());
    for (const std::string& name : {object.covered_file, object.material_file}) {
      if (!name.empty()) out.insert(name);
    }
    for (const SceneTexture& texture : object.textures) {
      for (const SceneFile& each : format_texture_in_scene(texture)) out.insert(each.name);
    }
  }
  return out;
}

// What registration.json has of the last call ends with the last scan of it.
void forget_run(EarlierScene& earlier, const std::string& name) {
  Json& registration = earlier.registration;
  Json left = Json::array();
  if (const Json* registered = registration.find("registered")) {
    for (const Json& other : *registered) {
      if (other != Json(name)) left.push_back(other);
    }
  }
  registration["registered"] = left;
  if (left.empty()) {
    for (const char* key : {"T_mesh_world", "rms_m", "mean_m", "converged", "stopped_by", "iterations", "points",
                            "outliers", "undetermined", "runner_up", "covariance", "bulge", "overlaps", "coordinates",
                            "problems", "verdict", "verdicts"})
      registration.erase(key);
    if (earlier.scene.T_mesh_world) registration["T_mesh_world"] = pose_json(*earlier.scene.T_mesh_world);
  }
  bool trustworthy = true;
  for (const Json& scan : registration.at("scans")) trustworthy = trustworthy && scan.value("verdict", "") != "invalid";
  registration["trustworthy"] = trustworthy;
}

// Another name for the same bytes, or a copy of them.
void put_file(const fs::path& from, const fs::path& to) {
  fs::create_directories(to.parent_path());
  std::error_code error;
  fs::create_hard_link(from, to, error);
  if (error) write_file(to, read_file(from, std::uint64_t{1} << 40));
}

}  // namespace

EarlierScene scene_of_mesh(MeshFile mesh, double unit_m) {
  EarlierScene out;
  SceneObject& object = out.scene.objects.emplace_back();
  object.mesh_file = "textured.obj";
  object.unit_m = unit_m;
  object.mesh = std::move(mesh);
  return out;
}

EarlierScene read_earlier_scene(const fs::path& scene, const Observer& observer) {
  EarlierScene out;
  out.file = scene.filename().string();
  out.folder = fs::weakly_canonical(fs::absolute(scene).parent_path());
  out.given = scene.has_parent_path() ? scene.parent_path() : fs::path(".");
  out.checksum = scene_checksum(out.folder, out.file);
  out.scene = read_scene(scene, observer);
  out.files = files_of_ours(out.folder);
  out.own_files = files_of_scene(out.scene, out.file);
  name_meshes_obj(out.scene);
  const fs::path registration = out.folder / kRegistration;
  if (!out.files.contains(kRegistration) || !fs::is_regular_file(registration)) return out;
  const std::string name = printable((out.given / kRegistration).string());
  out.registration = parse_json(read_file(registration, kLargestListing_bytes), name, {}, observer.without_progress());
  try {
    add_origins(out);
    if (const Json* placements = out.registration.find("placements")) {
      for (const Json& placement : placements->list()) placement.at("scans").list();
    }
  } catch (const Error& error) {
    throw Error(name + ": is not a registration: " + error.what());
  }
  return out;
}

std::string scene_checksum(const fs::path& folder, const std::string& scene) {
  std::string out;
  for (const std::string& name : {scene, std::string(kRegistration)}) {
    if (fs::is_regular_file(folder / name)) out += md5_hex(read_file(folder / name, kLargestListing_bytes));
    out += ' ';
  }
  return out;
}

std::set<std::string> files_of_ours(const fs::path& folder) noexcept {
  try {
    std::set<std::string> out;
    add_listed(folder / kRegistration, "asperity-registration", out);
    add_listed(folder / kListingFile, "asperity-files", out);
    return out;
  } catch (const std::exception&) {
    return {};
  }
}

std::set<std::string> files_of_scan(const EarlierScene& earlier, const std::string& name) {
  std::set<std::string> out;
  const Json* entry = find_entry(earlier.registration, name);
  if (entry != nullptr && entry->contains("files")) {
    for (const Json& file : entry->at("files")) out.insert(file.get<std::string>());
    return out;
  }
  for (const std::string& file : earlier.files) {
    if (file.starts_with(name + "/")) out.insert(file);
  }
  if (!out.empty() || entry == nullptr || earlier.registration.at("scans").size() > 1) return out;
  for (const char* file : {"trajectory.csv", "profile.csv", "spectrum.csv", "texture.json", "result.json"}) {
    if (earlier.files.contains(file)) out.insert(file);
  }
  return out;
}

std::vector<const SceneTexture*> scans_of(const Scene& scene) {
  std::vector<const SceneTexture*> out;
  for (const SceneTexture& texture : scene.objects.front().textures) {
    if (texture.origin && texture.origin->is_scan()) out.push_back(&texture);
  }
  return out;
}

std::map<int, Json> stored_scans(const EarlierScene& earlier) {
  std::map<int, Json> out;
  if (earlier.registration.is_object()) {
    for (const Json& scan : earlier.registration.at("scans")) out[scan.at("texture").get<int>()] = scan;
  }
  for (const SceneTexture* texture : scans_of(earlier.scene)) {
    const auto [found, is_new] = out.try_emplace(texture->index);
    Json& scan = found->second;
    if (is_new) {
      scan["name"] = texture->origin->name;
      scan["texture"] = texture->index;
      scan["order"] = texture->order;
      if (texture->origin->placement) scan["placement"] = *texture->origin->placement;
    }
    if (texture->origin->T_mesh_world && !scan.contains("T_mesh_world"))
      scan["T_mesh_world"] = pose_json(*texture->origin->T_mesh_world);
  }
  return out;
}

Json stored_placements(const EarlierScene& earlier, const std::vector<std::string>& gone) {
  Json out = Json::array();
  if (const Json* listed = earlier.registration.find("placements")) out = *listed;
  std::size_t count = out.size();
  for (const SceneTexture* scan : scans_of(earlier.scene))
    count = std::max(count, static_cast<std::size_t>(scan->origin->placement.value_or(1)));
  for (std::size_t k = 0; k < out.size(); ++k) {
    Json left = Json::array();
    for (const Json& name : out[k].at("scans")) {
      if (std::none_of(gone.begin(), gone.end(), [&](const std::string& other) { return name == Json(other); }))
        left.push_back(name);
    }
    out[k]["scans"] = std::move(left);
  }
  // Not listed: of a scene whose registration.json is gone, or from before there were placements.
  while (out.size() < count) {
    Json placement;
    placement["scans"] = Json::array();
    for (const SceneTexture* scan : scans_of(earlier.scene)) {
      if (scan->origin->placement.value_or(1) != static_cast<int>(out.size()) + 1) continue;
      if (std::find(gone.begin(), gone.end(), scan->origin->name) != gone.end()) continue;
      placement["scans"].push_back(scan->origin->name);
    }
    out.push_back(std::move(placement));
  }
  while (!out.empty() && out.back().at("scans").empty()) out.erase_at(out.size() - 1);
  return out;
}

std::vector<ScanPlace> place_scans(const EarlierScene& earlier, const std::vector<std::string>& names) {
  const SceneObject& object = earlier.object();
  const int order = further_order(object, earlier.at);
  const bool alone = names.size() == 1 && earlier.folder.empty();
  const std::map<int, Json> stored = stored_scans(earlier);
  std::vector<ScanPlace> out;
  std::set<int> indices;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), name) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      throw Error("registration: two scans are called '" + printable(name) + "'");
    if (!alone && (!stays_inside(name) || fs::path(name).has_parent_path()))
      throw Error("registration: '" + printable(name) + "' cannot be the name of a scan's folder");
    ScanPlace place;
    place.folder = alone ? "" : name;
    for (const SceneTexture* scan : scans_of(earlier.scene)) {
      if (scan->origin->name != name) continue;
      place.texture = scan->index;
      place.order = scan->order;
      place.file = scan->file;
      place.replaces = true;
    }
    // A scan of which no texture could be made has its index in the registration alone.
    if (const Json* entry = find_entry(earlier.registration, name); entry != nullptr && !place.replaces) {
      place.texture = entry->at("texture").get<int>();
      place.order = order;
      place.replaces = true;
    } else if (!place.replaces) {
      place.texture = std::max(free_texture_index(object), indices.empty() ? 1 : *indices.rbegin() + 1);
      if (!stored.empty()) place.texture = std::max(place.texture, stored.rbegin()->first + 1);
      place.order = order;
    }
    if (place.file.empty())
      place.file = free_file_name(earlier.scene, "scan" + std::to_string(place.texture) + ".texture.json");
    indices.insert(place.texture);
    out.push_back(std::move(place));
  }
  return out;
}

std::set<std::string> take_out_scan(EarlierScene& earlier, const std::string& name) {
  const std::vector<const SceneTexture*> scans = scans_of(earlier.scene);
  const auto found =
      std::find_if(scans.begin(), scans.end(), [&](const SceneTexture* scan) { return scan->origin->name == name; });
  const Json* entry = find_entry(earlier.registration, name);
  if (found == scans.end() && entry == nullptr) {
    std::string all;
    for (const SceneTexture* scan : scans) all += (all.empty() ? "" : ", ") + printable(scan->origin->name, 200);
    throw Error("the scene has no scan '" + printable(name, 200) + "'; " +
                (all.empty() ? "it has none" : "its scans are " + all));
  }
  std::set<std::string> out = files_of_scan(earlier, name);
  SceneObject& object = earlier.object();
  const bool measured = is_of_scans(object);
  take_out_texture(object, found != scans.end() ? (*found)->index : entry->at("texture").get<int>());
  if (measured) set_scan_materials(object, free_file_name(earlier.scene, "material.csv"));
  const std::vector<const SceneTexture*> left = scans_of(earlier.scene);
  earlier.scene.T_mesh_world = left.empty() ? std::nullopt : left.front()->origin->T_mesh_world;
  if (entry != nullptr) {
    Json& entries = earlier.registration["scans"];
    entries.erase_at(static_cast<std::size_t>(entry - entries.begin()));
    earlier.registration["placements"] = stored_placements(earlier, {name});
    forget_run(earlier, name);
  }
  return out;
}

void write_scene_again(const fs::path& folder, const EarlierScene& earlier, const std::set<std::string>& dropped,
                       bool listing) {
  for (const SceneFile& file : format_scene_files(earlier.file, earlier.scene)) {
    if (fs::exists(folder / file.name))
      throw Error("scene: '" + printable(file.name, 200) + "' would be both a file of the scene and of a scan");
    fs::create_directories((folder / file.name).parent_path());
    write_file(folder / file.name, file.content);
  }
  std::set<std::string> replaced = dropped;
  replaced.insert(earlier.own_files.begin(), earlier.own_files.end());
  replaced.insert({kRegistration, kListingFile, "report.html", earlier.file});
  for (const std::string& name : earlier.files) {
    if (replaced.contains(name) || !stays_inside(name)) continue;
    if (fs::is_regular_file(earlier.folder / name) && !fs::exists(folder / name))
      put_file(earlier.folder / name, folder / name);
  }
  if (earlier.registration.is_null()) return;
  Json registration = earlier.registration;
  std::vector<std::string> files = all_files(folder);
  if (listing) files.push_back(kListingFile);
  registration["files"] = files;
  write_file(folder / kRegistration, registration.dump_repaired(2) + "\n");
}

}  // namespace asperity
