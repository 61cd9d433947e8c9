#include "asperity/session/register_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/md5.h"
#include "asperity/base/text.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/pipeline/scan_points.h"
#include "asperity/recording/fingerprint.h"
#include "asperity/recording/read_recording.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/set_mesh_unit.h"
#include "asperity/texture/texture_file.h"

namespace asperity {

namespace {

namespace fs = std::filesystem;

// The last part of a path without the ending of a file.
std::string scan_name(const std::string& path) {
  fs::path whole = fs::absolute(path).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  return fs::is_directory(path) ? whole.filename().string() : whole.stem().string();
}

Scan read_scan(const std::string& path, const Observer& observer) {
  Scan scan;
  scan.name = scan_name(path);
  if (fs::is_directory(path)) {
    scan.recording = read_recording(path, {}, observer);
  } else {
    scan.path = read_path(path);
  }
  scan.checksum = recording_checksum(path);
  return scan;
}

// A scan that the scene has under another name is no second measurement, to an area least of all.
void check_new(const RegisterInput& input, const std::vector<std::string>& names) {
  std::vector<NamedFingerprint> scans;
  for (const auto& [index, stored] : stored_scans(input.onto)) {
    const std::string name = stored.value("name", "");
    if (std::find(names.begin(), names.end(), name) != names.end() || !stored.contains("fingerprint")) continue;
    scans.push_back({name, parse_fingerprint(stored.at("fingerprint"))});
  }
  const std::size_t stored = scans.size();
  for (const Scan& scan : input.scans) {
    scans.push_back({scan.name, fingerprint_of(scan)});
  }
  if (stored > 0) check_independent(scans);
}

// No object is as large as the Earth.
constexpr double kAbsurd_m = 1e7;
// Nothing that a hand scans is as large as a house: the unit was forgotten.
constexpr double kLarge_m = 5.0;

}  // namespace

void check_register_input(const std::vector<std::string>& scans, const std::vector<std::string>& textures) {
  if (!textures.empty() && textures.size() != 1 && textures.size() != scans.size()) {
    throw Error(fmt::format("--texture: {} textures for {} paths", textures.size(), scans.size()));
  }
  std::set<std::string> names;
  for (const std::string& scan : scans) {
    const std::string name = scan_name(scan);
    if (!names.insert(name).second) throw Error("two paths are called '" + printable(name) + "'");
    if (scans.size() > 1 && !stays_inside(name)) {
      throw Error("'" + printable(name) + "' cannot be the name of a scan's folder");
    }
  }
}

std::string recording_checksum(const fs::path& path) {
  constexpr std::uint64_t kLargestFile_bytes = std::uint64_t{1} << 32;
  if (!fs::is_directory(path)) return "md5:" + md5_hex_of_file(path, kLargestFile_bytes);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path)) {
    const fs::path ending = entry.path().extension();
    if (entry.is_regular_file() && (ending == ".json" || ending == ".csv")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::string sums;
  for (const fs::path& file : files)
    sums += file.filename().string() + " " + md5_hex_of_file(file, kLargestFile_bytes) + "\n";
  return "md5:" + md5_hex(sums);
}

MeshFile read_register_mesh(const fs::path& file, const Observer& observer) {
  return std::move(read_scene(file, observer).objects.front().mesh);
}

bool is_same_mesh(const MeshFile& a, const MeshFile& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles;
}

RegisterInput read_register_input(const std::vector<std::string>& scans, const std::string& mesh,
                                  std::optional<double> unit_m, const std::vector<std::string>& textures,
                                  const Observer& observer) {
  check_register_input(scans, textures);
  RegisterInput out;
  if (fs::path(mesh).extension() == ".json") {
    out.onto = read_earlier_scene(mesh, observer);
    if (unit_m) set_mesh_unit(out.onto.scene, mesh, *unit_m);
  } else {
    out.onto = scene_of_mesh(read_mesh(mesh, {}, observer), unit_m.value_or(1.0));
    if (!unit_m) refuse_unlikely_metres(out.mesh(), mesh);
  }
  if (out.mesh().triangles.empty()) throw Error(printable(mesh, 200) + ": holds no faces");
  if (const double size_m = size_of_mesh_m(out.mesh(), out.unit_m()); !(size_m <= kAbsurd_m)) {
    throw Error(fmt::format("{}: the mesh is {:.3g} m large; is its unit right?", printable(mesh, 200), size_m));
  }
  for (std::size_t i = 0; i < scans.size(); ++i) {
    Scan& scan = out.scans.emplace_back(read_scan(scans[i], observer));
    if (!textures.empty()) scan.texture = read_texture(textures[textures.size() == 1 ? 0 : i], {}, observer);
  }
  return out;
}

ScansOnMesh register_input(const RegisterInput& input, const std::optional<Pose>& guess, const RegisterConfig& config,
                           const RegistrationObserver& observer) {
  std::vector<std::string> names;
  for (const Scan& scan : input.scans) names.push_back(scan.name);
  place_scans(input.onto, names);  // throws before the long part
  check_new(input, names);
  ScansOnMesh result = register_scans(input.scans, to_metres(input.mesh(), input.unit_m()), guess, config, observer);
  result.problems.insert(result.problems.begin(), input.mesh().problems.begin(), input.mesh().problems.end());
  if (const double size_m = size_of_mesh_m(input.mesh(), input.unit_m()); size_m > kLarge_m) {
    result.problems.push_back({"large_mesh", fmt::format("the mesh is {:.0f} m large; is its unit right?", size_m), 1});
  }
  return result;
}

}  // namespace asperity
