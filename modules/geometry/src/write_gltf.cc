#include "asperity/geometry/write_gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "gltf_buffer.h"
#include "gltf_corner.h"
#include "gltf_haptics.h"
#include "gltf_text.h"
#include "tinygltf_config.h"

namespace asperity {

namespace {

using tinygltf::Value;

[[noreturn]] void fail(const std::string& message) { throw Error("glTF: " + message); }

// The triangles of one primitive: those of one haptic texture and one material.
struct Group {
  bool normals = true;
  bool texture = true;
  bool colours = true;  // each of its vertices has one
  std::vector<std::uint32_t> triangles;
};

class GltfWriter {
 public:
  explicit GltfWriter(const GltfExport& scene) : scene_(scene), mesh_(scene.mesh) {}

  std::string write(GltfForm form) {
    check();
    model_.asset.version = "2.0";
    model_.asset.generator = "Asperity";
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    haptics_ = add_gltf_haptics(model_, buffer_, scene_);
    primitives();
    buffer_.close();
    return gltf_text(model_, form);
  }

 private:
  void check() const {
    const auto length = [](std::size_t have, std::size_t need, const char* what) {
      if (have != 0 && have != need)
        fail(std::to_string(have) + " " + what + " where " + std::to_string(need) + " are needed");
    };
    if (mesh_.triangles.empty()) fail("the mesh has no triangles");
    length(mesh_.texture_corners.size(), mesh_.triangles.size(), "texture corners");
    length(mesh_.normal_corners.size(), mesh_.triangles.size(), "normal corners");
    length(mesh_.vertex_colours.size(), mesh_.vertices.size(), "vertex colours");
    length(mesh_.haptic.size(), mesh_.triangles.size(), "haptic triangles");
    if (!(scene_.unit_m > 0.0) || !std::isfinite(scene_.unit_m)) fail("unit_m is " + number_text(scene_.unit_m));
    for (const GltfTexture& texture : scene_.textures) {
      if (!(texture.size_mm.minCoeff() > 0.0) || !texture.size_mm.allFinite())
        fail("haptic texture " + std::to_string(texture.index) + " has no size");
    }
  }

  // A material of glTF for the mesh's material and the haptic texture's place in scene_.textures; -1: none.
  int add_material(std::int32_t material, int haptic) {
    if (material < 0 && haptic < 0) return -1;
    tinygltf::Material& out = model_.materials.emplace_back();
    out.pbrMetallicRoughness.metallicFactor = 0.0;
    out.doubleSided = true;  // scanned surfaces are often open
    if (material >= 0) {
      if (static_cast<std::size_t>(material) >= mesh_.materials.size())
        fail("material " + std::to_string(material) + " does not exist");
      const MeshMaterial& m = mesh_.materials[static_cast<std::size_t>(material)];
      out.name = printable(m.name, 200);
      if (m.base_colour) {
        const Eigen::Vector3d c = m.base_colour->cwiseMax(0.0).cwiseMin(1.0);
        out.pbrMetallicRoughness.baseColorFactor = {c[0], c[1], c[2], 1.0};
      }
      if (!m.base_colour_map.empty()) out.pbrMetallicRoughness.baseColorTexture.index = file_texture(m.base_colour_map);
      if (!m.normal_map.empty() && haptic < 0) out.normalTexture.index = file_texture(m.normal_map);
    }
    if (haptic >= 0) {
      const auto place = static_cast<std::size_t>(haptic);
      if (out.name.empty()) out.name = printable(scene_.textures[place].name, 200);
      out.extras = Value(Value::Object{{"asperity", Value(haptics_.extra[place])}});
      if (haptics_.normal_map[place] >= 0) {
        out.normalTexture.index = haptics_.normal_map[place];
        out.normalTexture.texCoord = 1;
      }
    }
    return static_cast<int>(model_.materials.size()) - 1;
  }

  int file_texture(const std::string& file) {
    const auto [entry, is_new] = file_textures_.try_emplace(file, -1);
    if (is_new) entry->second = add_gltf_image(model_, buffer_, {"", "", file});
    return entry->second;
  }

  static bool has(const std::vector<Triangle>& corners, std::size_t triangle) {
    return !corners.empty() && corners[triangle][0] != kNoIndex;
  }

  bool has_colours(std::size_t triangle) const {
    if (mesh_.vertex_colours.empty()) return false;
    for (const std::uint32_t v : mesh_.triangles[triangle])
      if (v >= mesh_.vertex_colours.size() || !mesh_.vertex_colours[v].allFinite()) return false;
    return true;
  }

  // Groups the triangles, then writes one mesh a haptic texture, in rising order of its index.
  void primitives() {
    std::map<std::pair<std::int32_t, std::int32_t>, Group> groups;
    auto part = mesh_.parts.begin();
    std::int32_t material = -1;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      for (; part != mesh_.parts.end() && part->first_triangle <= i; ++part) material = part->material;
      const std::int32_t haptic = mesh_.haptic.empty() ? -1 : mesh_.haptic[i].texture;
      Group& group = groups[{haptic, material}];
      group.triangles.push_back(i);
      group.normals = group.normals && has(mesh_.normal_corners, i);
      group.texture = group.texture && has(mesh_.texture_corners, i);
      group.colours = group.colours && has_colours(i);
    }
    std::optional<std::int32_t> open;
    for (const auto& [key, group] : groups) {
      if (open != key.first) add_mesh(key.first);
      open = key.first;
      model_.meshes.back().primitives.push_back(primitive(key.first, key.second, group));
    }
  }

  void add_mesh(std::int32_t haptic) {
    tinygltf::Mesh& mesh = model_.meshes.emplace_back();
    const int place = haptics_.place_of(haptic);
    if (place >= 0)
      mesh.extensions.emplace(kMpegHapticMaterial, Value(Value::Object{{"hapticMaterialIndex", Value(place)}}));
    tinygltf::Node& node = model_.nodes.emplace_back();
    node.mesh = static_cast<int>(model_.meshes.size()) - 1;
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()) - 1);
  }

  GltfCorner corner_of(const Group& group, std::uint32_t triangle, std::size_t k, bool haptic) const {
    const auto index = [](std::uint32_t value, std::size_t count, const char* what) {
      if (value >= count) fail(std::string(what) + " " + std::to_string(value) + " of " + std::to_string(count));
      return value;
    };
    GltfCorner c{};
    c.vertex = index(mesh_.triangles[triangle][k], mesh_.vertices.size(), "vertex");
    if (group.texture)
      c.texture = index(mesh_.texture_corners[triangle][k], mesh_.texture_coordinates.size(), "texture coordinate");
    if (group.normals) c.normal = index(mesh_.normal_corners[triangle][k], mesh_.normals.size(), "normal");
    c.haptic = haptic ? mesh_.haptic[triangle].xy_mm[k] : Eigen::Vector2d::Zero().eval();
    return c;
  }

  tinygltf::Primitive primitive(std::int32_t haptic, std::int32_t material, const Group& group) {
    const bool is_haptic = haptic >= 0;
    const int place = haptics_.place_of(haptic);
    std::vector<GltfCorner> corners;
    std::unordered_map<GltfCorner, std::uint32_t, GltfCornerHash> places;
    const std::size_t begin = buffer_.size();
    for (const std::uint32_t triangle : group.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const GltfCorner c = corner_of(group, triangle, k, is_haptic);
        const auto [entry, is_new] = places.try_emplace(c, static_cast<std::uint32_t>(corners.size()));
        if (is_new) corners.push_back(c);
        buffer_.append(entry->second);
      }
    }
    tinygltf::Primitive out;
    out.mode = TINYGLTF_MODE_TRIANGLES;
    out.material = add_material(material, place);
    out.indices = buffer_.add_indices(begin, 3 * group.triangles.size());
    out.attributes["POSITION"] = positions(corners);
    if (group.normals) out.attributes["NORMAL"] = normals(corners);
    if (group.colours) out.attributes["COLOR_0"] = colours(corners);
    const Eigen::Vector2d size_mm =
        place >= 0 ? scene_.textures[static_cast<std::size_t>(place)].size_mm : Eigen::Vector2d::Ones();
    if (group.texture) out.attributes["TEXCOORD_0"] = texture_coordinates(corners);
    if (is_haptic) {
      const int accessor = haptic_coordinates(corners, size_mm);
      // glTF numbers its texture coordinates without gaps.
      if (!group.texture) out.attributes["TEXCOORD_0"] = accessor;
      out.attributes["TEXCOORD_1"] = accessor;
      out.extras = Value(
          Value::Object{{"asperity", Value(Value::Object{{"haptic_texture", Value(haptic)},
                                                         {"width_mm", Value(size_mm.x())},
                                                         {"height_mm", Value(size_mm.y())},
                                                         {"own_texture_coordinates", Value(group.texture ? 1 : 0)}})}});
    }
    return out;
  }

  int positions(const std::vector<GltfCorner>& corners) {
    const std::size_t begin = buffer_.size();
    std::array<float, 3> low, high;
    low.fill(std::numeric_limits<float>::infinity());
    high.fill(-std::numeric_limits<float>::infinity());
    for (const GltfCorner& c : corners) {
      const Eigen::Vector3d p_m = mesh_.vertices[c.vertex] * scene_.unit_m;
      for (std::size_t k = 0; k < 3; ++k) {
        buffer_.append_float(p_m[static_cast<Eigen::Index>(k)], "a position");
        low[k] = std::min(low[k], static_cast<float>(p_m[static_cast<Eigen::Index>(k)]));
        high[k] = std::max(high[k], static_cast<float>(p_m[static_cast<Eigen::Index>(k)]));
      }
    }
    const int accessor = buffer_.add_floats(begin, TINYGLTF_TYPE_VEC3, corners.size());
    model_.accessors.back().minValues.assign(low.begin(), low.end());
    model_.accessors.back().maxValues.assign(high.begin(), high.end());
    return accessor;
  }

  int normals(const std::vector<GltfCorner>& corners) {
    const std::size_t begin = buffer_.size();
    for (const GltfCorner& c : corners) {
      Eigen::Vector3d n = mesh_.normals[c.normal].stableNormalized();
      if (!n.allFinite() || n.isZero(0.0))
        n = Eigen::Vector3d::UnitZ();  // glTF wants unit normals; one of length zero points nowhere
      for (int k = 0; k < 3; ++k) buffer_.append_float(n[k], "a normal");
    }
    return buffer_.add_floats(begin, TINYGLTF_TYPE_VEC3, corners.size());
  }

  int colours(const std::vector<GltfCorner>& corners) {
    const std::size_t begin = buffer_.size();
    for (const GltfCorner& c : corners)
      for (int k = 0; k < 3; ++k)
        buffer_.append_float(std::clamp(mesh_.vertex_colours[c.vertex][k], 0.0, 1.0), "a colour");
    return buffer_.add_floats(begin, TINYGLTF_TYPE_VEC3, corners.size());
  }

  int texture_coordinates(const std::vector<GltfCorner>& corners) {
    const std::size_t begin = buffer_.size();
    for (const GltfCorner& c : corners) {
      buffer_.append_float(mesh_.texture_coordinates[c.texture].x(), "a texture coordinate");
      buffer_.append_float(1.0 - mesh_.texture_coordinates[c.texture].y(), "a texture coordinate");
    }
    return buffer_.add_floats(begin, TINYGLTF_TYPE_VEC2, corners.size());
  }

  int haptic_coordinates(const std::vector<GltfCorner>& corners, const Eigen::Vector2d& size_mm) {
    const std::size_t begin = buffer_.size();
    for (const GltfCorner& c : corners) {
      buffer_.append_float(c.haptic.x() / size_mm.x(), "a haptic coordinate");
      buffer_.append_float(c.haptic.y() / size_mm.y(), "a haptic coordinate");
    }
    return buffer_.add_floats(begin, TINYGLTF_TYPE_VEC2, corners.size());
  }

  const GltfExport& scene_;
  const MeshFile& mesh_;
  tinygltf::Model model_;
  GltfBuffer buffer_{model_};
  GltfHaptics haptics_;
  std::map<std::string, int> file_textures_;
};

}  // namespace

std::string format_gltf(const GltfExport& scene, GltfForm form) { return GltfWriter(scene).write(form); }

void write_gltf(const std::filesystem::path& path, const GltfExport& scene) {
  const std::string extension = path.extension().string();
  if (extension != ".glb" && extension != ".gltf") throw Error(path.string() + ": a glTF file ends in .glb or .gltf");
  write_file(path, format_gltf(scene, extension == ".glb" ? GltfForm::kBinary : GltfForm::kJson));
}

}  // namespace asperity
