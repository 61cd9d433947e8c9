#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/geometry/pose.h"
#include "asperity/json/json.h"

namespace asperity {

// What laid a texture on an object, as `kind`; other programs may have others.
inline constexpr std::string_view kScanOrigin = "scan", kPaintedOrigin = "painted", kSwappedOrigin = "swapped";

// Where a texture of a scene came from: textures[].source of scene.json. What is empty is not known.
struct TextureOrigin {
  std::string kind;
  std::string name;                  // of the recording or path, of the painted texture
  std::string checksum;              // of the recording: "md5:" and 32 digits. No path: scenes are passed on
  Json fingerprint;                  // of its samples (fingerprint_json()); null: not known
  std::optional<Pose> T_mesh_world;  // of a scan: tracker's world to mesh
  std::optional<int> placement;      // its number in the scene, from 1: scans of one share their pose
  std::vector<std::vector<Eigen::Vector3d>> strokes_mesh_m;  // of a painted texture: the points of each stroke
  std::string date;                                          // only if it was given
  std::string version;                                       // of the program
  Json settings = Json::object();                            // that differ from the usual ones, by their paths
  Json rest = Json::object();                                // what others have put there, kept as it is

  bool is_scan() const { return kind == kScanOrigin; }
};

// The settings that differ from `usual`, a list of the same fields: values by their dotted paths; empty if none does.
Json changed_settings(const std::vector<ConfigField>& fields, const std::vector<ConfigField>& usual);

}  // namespace asperity
