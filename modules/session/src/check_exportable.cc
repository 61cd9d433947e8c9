#include "asperity/session/check_exportable.h"

#include <string>
#include <variant>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/scene/export_scene.h"
#include "asperity/session/export_heights.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// What an export can start from.
struct ExportableParts {
  bool mesh = false;
  bool texture = false;
  bool heights = false;  // of a texture
  bool profile = false;  // profile.csv
  bool map = false;      // an areal texture
  std::vector<std::string> names;
};

ExportableParts parts_of(const fs::path& source, const Scene& scene) {
  ExportableParts out;
  for (const SceneObject& object : scene.objects) {
    if (!object.mesh.triangles.empty()) {
      out.mesh = true;
      out.names.push_back("a mesh (" + printable(object.mesh_file, 100) + ")");
    }
    for (const SceneTexture& texture : object.textures) {
      out.texture = true;
      out.heights = out.heights || is_height_field(texture.texture.model);
      out.map = out.map || std::holds_alternative<ArealTexture>(texture.texture.model);
      out.names.push_back(printable(texture.file, 100) + " (" + std::string(texture.texture.model_name()) + ")");
    }
  }
  if (fs::is_directory(source) && fs::exists(source / "profile.csv")) {
    out.profile = true;
    out.names.emplace_back("profile.csv");
  }
  return out;
}

// What `format` needs and `parts` have not; empty if they have it.
std::string missing_part(const ExportableParts& parts, std::string_view format) {
  if (format == "obj" || format == "gltf" || format == "usda" || format == "stl") return parts.mesh ? "" : "a mesh";
  if (format == "x3p") return parts.heights || parts.profile ? "" : "a texture with heights or a profile.csv";
  if (height_file_of(format)) return parts.profile || parts.map ? "" : "a profile.csv or an areal map";
  if (!parts.texture) return "a texture";
  return format != "png" || parts.heights ? "" : "a texture with heights";
}

// "a, b and c"; of many the first, and how many more.
std::string listed_names(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 4;
  std::string out;
  const std::size_t shown = names.size() > kMost ? kMost - 1 : names.size();
  for (std::size_t i = 0; i < shown; ++i) out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return names.size() > kMost ? out + " and " + std::to_string(names.size() - shown) + " more" : out;
}

}  // namespace

void check_exportable(const fs::path& source, const Scene& scene, std::string_view format) {
  const ExportableParts parts = parts_of(source, scene);
  const std::string missing = missing_part(parts, format);
  if (missing.empty()) return;
  std::string possible;
  std::vector<std::string_view> formats(kExportFormatNames.begin(), kExportFormatNames.end());
  formats.insert(formats.end(), {"sdf", "sdf-binary", "gsf"});
  for (const std::string_view other : formats)
    if (missing_part(parts, other).empty()) possible += (possible.empty() ? "" : ", ") + std::string(other);
  std::string text =
      printable(source.string(), 200) + ": " + std::string(format) + " needs " + missing + ", and there is none";
  if (!parts.names.empty()) text += ", only " + listed_names(parts.names);
  text += possible.empty() ? ". It cannot be exported" : ". It can be exported to " + possible;
  if (missing == "a mesh" && parts.texture) text += "; `asperity paint` lays a texture on a mesh";
  throw Error(text);
}

}  // namespace asperity
