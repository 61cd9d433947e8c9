#include "asperity/session/area_input.h"

#include <algorithm>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/fingerprint.h"
#include "asperity/scene/lay_texture.h"
#include "asperity/scene/read_scene.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLargestTable_bytes = std::uint64_t{1} << 30;

MeshPath read_mesh_path(const fs::path& file, std::size_t triangles) {
  const std::string text = read_file(file, kLargestTable_bytes);
  CsvReader csv(text, printable(file.string(), 200));
  const std::size_t s = csv.require("s_m"), x = csv.require("px_m"), y = csv.require("py_m"), z = csv.require("pz_m");
  const std::size_t triangle = csv.require("triangle");
  MeshPath out;
  while (csv.next()) {
    const std::int64_t t = csv.integer(triangle);
    if (t < 0 || static_cast<std::uint64_t>(t) >= triangles)
      csv.fail(triangle, std::to_string(t) + " is not a triangle of the mesh, which has " + std::to_string(triangles));
    const double s_m = csv.finite(s);
    if (!out.s_m.empty() && !(s_m > out.s_m.back())) csv.fail(s, number_text(s_m) + " m does not rise");
    out.s_m.push_back(s_m);
    out.p_mesh_m.emplace_back(csv.finite(x), csv.finite(y), csv.finite(z));
    out.triangle.push_back(static_cast<std::uint32_t>(t));
  }
  return out;
}

Profile read_profile(const fs::path& file) {
  const std::string text = read_file(file, kLargestTable_bytes);
  CsvReader csv(text, printable(file.string(), 200));
  const std::size_t s = csv.require("s_m"), height = csv.require("height_m");
  const auto noise = csv.find("texture_sigma_m");
  Profile out;
  while (csv.next()) {
    const double s_m = csv.finite(s);
    if (!out.s_m.empty() && !(s_m > out.s_m.back())) csv.fail(s, number_text(s_m) + " m does not rise");
    out.s_m.push_back(s_m);
    out.height_m.push_back(csv.finite_or_nan(height));
    if (noise) out.texture_sigma_m.push_back(csv.finite_or_nan(*noise));
  }
  if (out.size() > 1) out.spacing_m = (out.s_m.back() - out.s_m.front()) / static_cast<double>(out.size() - 1);
  return out;
}

// Throws Error for what is not the form of a registration.json that `register` writes.
void check_registration(const Json& registration, const std::string& name) {
  const auto wrong = [&](const std::string& what) { throw Error(name + ": " + what); };
  const Json* format = registration.find("format");
  if (format == nullptr || *format != Json("asperity-registration")) wrong("is not a registration of asperity");
  const Json* scans = registration.find("scans");
  if (scans == nullptr || !scans->is_array()) wrong("has no list 'scans'");
  for (std::size_t i = 0; i < scans->size(); ++i) {
    const Json* of_scan = scans->at(i).find("name");
    if (of_scan == nullptr || !of_scan->is_string()) wrong("scans[" + std::to_string(i) + "] has no name");
  }
}

bool is_invalid(const Json& verdict) { return verdict.value("verdict", "") == "invalid"; }

// The placement that a scan is in; null where the file has none.
const Json* placement_of(const Json& registration, const std::string& scan) {
  const Json* placements = registration.find("placements");
  if (placements == nullptr || !placements->is_array()) return nullptr;
  for (const Json& placement : *placements) {
    const Json* scans = placement.find("scans");
    if (scans == nullptr || !scans->is_array()) continue;
    for (const Json& name : *scans)
      if (name == Json(scan)) return &placement;
  }
  return nullptr;
}

// The first sentence of what makes a scan invalid.
std::string reason_of(const Json& scan) {
  const Json* verdicts = scan.find("verdicts");
  if (verdicts == nullptr || !verdicts->is_array()) return "its verdict is invalid";
  for (const Json& verdict : *verdicts)
    if (verdict.value("severity", "") == "invalid") return verdict.value("message", "its verdict is invalid");
  return "its verdict is invalid";
}

// Those that are named, and those whose pose is known and whose heights are not.
std::vector<LeftOutScan> left_out_of(const Json& registration, const std::vector<std::string>& leave_out,
                                     const std::string& name) {
  std::vector<LeftOutScan> out;
  for (const Json& scan : registration.at("scans")) {
    const std::string of_scan = scan.at("name").get<std::string>();
    if (std::find(leave_out.begin(), leave_out.end(), of_scan) != leave_out.end()) {
      out.push_back({of_scan, "as asked for"});
      continue;
    }
    const Json* placement = placement_of(registration, of_scan);
    if (is_invalid(scan) && placement != nullptr && !is_invalid(*placement)) out.push_back({of_scan, reason_of(scan)});
  }
  for (const std::string& asked : leave_out) {
    if (std::none_of(out.begin(), out.end(), [&](const LeftOutScan& scan) { return scan.name == asked; }))
      throw Error(name + ": has no scan '" + printable(asked, 200) + "' to leave out");
  }
  return out;
}

// Whether what remains is not invalid: the placements of the scans that are used, and all that was said of the
// registration but of scans that are left out.
bool is_registered(const Json& registration, const std::vector<std::string>& names,
                   const std::vector<LeftOutScan>& left_out) {
  const Json* trustworthy = registration.find("trustworthy");
  if (trustworthy != nullptr && *trustworthy == Json(true)) return true;
  const Json* verdicts = registration.find("verdicts");
  if (left_out.empty() || verdicts == nullptr || !verdicts->is_array()) return false;
  for (const Json& verdict : *verdicts) {
    const std::string message = verdict.value("message", "");
    const bool of_left_out = std::any_of(left_out.begin(), left_out.end(), [&](const LeftOutScan& scan) {
      return message.starts_with(printable(scan.name, 200) + ": ");
    });
    if (verdict.value("severity", "") == "invalid" && !of_left_out) return false;
  }
  for (const Json& scan : registration.at("scans")) {
    const std::string name = scan.at("name").get<std::string>();
    const bool used =
        std::none_of(left_out.begin(), left_out.end(), [&](const LeftOutScan& other) { return other.name == name; });
    if (used && (is_invalid(scan) || placement_of(registration, name) == nullptr)) return false;
  }
  return !names.empty();
}

}  // namespace

AreaInput read_area_input(const fs::path& folder, const Observer& observer, const std::vector<std::string>& leave_out) {
  AreaInput out;
  const fs::path file = folder / "registration.json";
  const std::string name = printable(file.string(), 200);
  if (!fs::is_regular_file(file))
    throw Error(printable(folder.string(), 200) + ": has no registration.json; give a folder that `register` wrote");
  const Json registration = parse_json(read_file(file, std::uint64_t{64} << 20), name, {}, observer);
  check_registration(registration, name);
  out.left_out = left_out_of(registration, leave_out, name);
  out.scene = read_scene(folder / "scene.json", observer);
  const std::size_t triangles = out.scene.objects.front().mesh.triangles.size();
  std::vector<std::string> names;
  std::vector<NamedFingerprint> measured_from;
  for (const Json& scan : registration.at("scans")) {
    names.push_back(scan.at("name").get<std::string>());
    if (scan.contains("fingerprint"))
      measured_from.push_back({names.back(), parse_fingerprint(scan.at("fingerprint"))});
  }
  try {
    check_independent(measured_from);
  } catch (const Error& error) {
    throw Error(name + ": " + error.what());
  }
  out.registered = is_registered(registration, names, out.left_out);
  bool any_path = false;
  for (const std::string& scan : names) {
    if (!stays_inside(scan)) continue;  // its folder would not be in this one
    fs::path place = folder / scan;
    if (names.size() == 1 && !fs::is_directory(place)) place = folder;
    if (!fs::is_regular_file(place / "path.csv")) continue;
    any_path = true;
    if (std::any_of(out.left_out.begin(), out.left_out.end(),
                    [&](const LeftOutScan& other) { return other.name == scan; }))
      continue;
    if (!fs::is_regular_file(place / "profile.csv")) continue;
    AreaScan one{scan, read_mesh_path(place / "path.csv", triangles), read_profile(place / "profile.csv")};
    if (one.path.size() > 1 && one.profile.size() > 1) out.scans.push_back(std::move(one));
  }
  if (out.scans.empty()) {
    throw Error(name + (any_path ? ": none of its scans has a path and a profile and is not left out"
                                 : ": none of its scans has a path.csv; register them again with this version"));
  }
  return out;
}

const SceneTexture& add_area(Scene& scene, const AreaResult& area) {
  SceneObject& object = scene.objects.front();
  SceneTexture texture;
  texture.index = free_texture_index(object);
  texture.order = further_order(object, LayAt::kOver);
  texture.file = "area.texture.json";
  for (int n = 2; free_file_name(scene, texture.file) != texture.file; ++n)
    texture.file = "area-" + std::to_string(n) + ".texture.json";
  texture.texture = area.texture.value();
  std::vector<CoveredTriangle> claims;
  for (std::size_t i = 0; i < area.triangle.size(); ++i) {
    claims.push_back({area.triangle[i], area.coordinates[i]});
    claims.back().haptic.texture = texture.index;
  }
  const int index = texture.index;
  put_texture(object, std::move(texture));
  lay_triangles(object, claims);
  return *object.find_texture(index);
}

}  // namespace asperity
