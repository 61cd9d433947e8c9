#include "asperity/scene/format_usda.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "mesh_groups.h"

namespace asperity {

namespace {

[[noreturn]] void fail_usda(const std::string& message) { throw Error("USDA: " + message); }

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : printable(text, 1000)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

// A file's name as an asset path: between @, or between @@@ where it has an @ itself (then @@@ in it is \@@@).
std::string asset_path(const std::string& file) {
  const std::string name = printable(file, 300);
  if (name.find('@') == std::string::npos) return "@" + name + "@";
  std::string out = "@@@";
  for (std::size_t i = 0; i < name.size();) {
    if (name.compare(i, 3, "@@@") == 0) {
      out += "\\@@@";
      i += 3;
    } else {
      out += name[i++];
    }
  }
  return out + "@@@";
}

// A name of letters, digits and _ that no other has.
std::string identifier(const std::string& text, std::set<std::string>& used) {
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    out += plain ? c : '_';
  }
  if (out.empty() || (out[0] >= '0' && out[0] <= '9')) out = "_" + out;
  std::string name = out;
  for (int i = 2; !used.insert(name).second; ++i) name = out + "_" + std::to_string(i);
  return name;
}

class UsdaWriter {
 public:
  UsdaWriter(const std::string& name, const MeshFile& mesh, double unit_m, const std::vector<UsdaTexture>& textures)
      : mesh_(mesh), unit_m_(unit_m), textures_(textures), groups_(mesh_groups(mesh)) {
    std::set<std::string> used;
    root_ = identifier(name, used);
  }

  std::string write() {
    if (mesh_.triangles.empty()) fail_usda("the mesh has no triangles");
    if (!(unit_m_ > 0.0) || !std::isfinite(unit_m_)) fail_usda("unit_m is " + number_text(unit_m_));
    for (const Triangle& triangle : mesh_.triangles)
      for (const std::uint32_t v : triangle)
        if (v >= mesh_.vertices.size())
          fail_usda("vertex " + std::to_string(v) + " of " + std::to_string(mesh_.vertices.size()));
    add("#usda 1.0\n(\n    customLayerData = {{\n        string creator = \"asperity {}\"\n    }}\n", kVersion);
    add("    defaultPrim = \"{}\"\n    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n\ndef Xform \"{}\"\n{{\n", root_,
        root_);
    write_mesh();
    write_materials();
    add("}}\n");
    return std::move(out_);
  }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> form, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), form, std::forward<Args>(args)...);
  }

  float single(double value) const {
    if (!std::isfinite(value) || std::abs(value) > std::numeric_limits<float>::max())
      fail_usda("a number of the mesh is " + number_text(value));
    return static_cast<float>(value) + 0.0F;
  }

  const UsdaTexture* find(std::int32_t index) const {
    for (const UsdaTexture& texture : textures_)
      if (texture.index == index) return &texture;
    return nullptr;
  }

  // An array of what `item` writes for 0 … count − 1.
  template <class Item>
  void array(const std::string& head, std::size_t count, const Item& item, const char* interpolation = nullptr) {
    out_ += "        " + head + " = [";
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) out_ += ", ";
      item(i);
    }
    out_ += "]";
    if (interpolation != nullptr) add(" (\n            interpolation = \"{}\"\n        )", interpolation);
    out_ += "\n";
  }

  void write_mesh() {
    add("    def Mesh \"mesh\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {{\n");
    add("        uniform bool doubleSided = 1\n        uniform token orientation = \"rightHanded\"\n");
    add("        uniform token subdivisionScheme = \"none\"\n");
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector3d high = -low;
    for (const Eigen::Vector3d& vertex : mesh_.vertices) {
      low = low.cwiseMin(vertex);
      high = high.cwiseMax(vertex);
    }
    const auto point = [&](const Eigen::Vector3d& p) {
      add("({}, {}, {})", single(p.x()), single(p.y()), single(p.z()));
    };
    array("float3[] extent", 2, [&](std::size_t i) { point((i == 0 ? low : high) * unit_m_); });
    array("int[] faceVertexCounts", mesh_.triangles.size(), [&](std::size_t) { out_ += '3'; });
    array("int[] faceVertexIndices", 3 * mesh_.triangles.size(),
          [&](std::size_t i) { add("{}", mesh_.triangles[i / 3][i % 3]); });
    array("point3f[] points", mesh_.vertices.size(), [&](std::size_t i) { point(mesh_.vertices[i] * unit_m_); });
    corner_values();
    for (auto group = groups_.begin(); group != groups_.end(); ++group) write_subset(*group);
    add("    }}\n");
  }

  // Whether each corner of each triangle has a value in a table of that size.
  bool complete(const std::vector<Triangle>& corners, std::size_t size) const {
    if (corners.size() != mesh_.triangles.size()) return false;
    return std::all_of(corners.begin(), corners.end(), [&](const Triangle& t) {
      return std::all_of(t.begin(), t.end(), [&](std::uint32_t i) { return i < size; });
    });
  }

  void corner_values() {
    const std::size_t corners = 3 * mesh_.triangles.size();
    if (complete(mesh_.normal_corners, mesh_.normals.size())) {
      array(
          "normal3f[] normals", corners,
          [&](std::size_t i) {
            Eigen::Vector3d n = mesh_.normals[mesh_.normal_corners[i / 3][i % 3]].stableNormalized();
            if (!n.allFinite() || n.isZero(0.0)) n = Eigen::Vector3d::UnitZ();
            add("({}, {}, {})", single(n.x()), single(n.y()), single(n.z()));
          },
          "faceVarying");
    }
    const auto coordinates = [&](const char* head, const auto& uv) {
      array(
          head, corners,
          [&](std::size_t i) {
            const Eigen::Vector2d p = uv(i / 3, i % 3);
            add("({}, {})", single(p.x()), single(p.y()));
          },
          "faceVarying");
    };
    own_coordinates_ = complete(mesh_.texture_corners, mesh_.texture_coordinates.size());
    if (own_coordinates_) {
      coordinates("texCoord2f[] primvars:st", [&](std::size_t t, std::size_t k) -> Eigen::Vector2d {
        return mesh_.texture_coordinates[mesh_.texture_corners[t][k]].head<2>();
      });
    }
    if (!mesh_.haptic.empty()) {
      coordinates("texCoord2f[] primvars:haptic", [&](std::size_t t, std::size_t k) -> Eigen::Vector2d {
        const HapticTriangle& haptic = mesh_.haptic[t];
        const UsdaTexture* texture = find(haptic.texture);
        if (haptic.texture < 0) return Eigen::Vector2d::Zero();
        const Eigen::Vector2d size_mm = texture == nullptr ? Eigen::Vector2d::Ones() : texture->size_mm;
        return {haptic.xy_mm[k].x() / size_mm.x(), 1.0 - haptic.xy_mm[k].y() / size_mm.y()};
      });
    }
    const bool coloured = mesh_.vertex_colours.size() == mesh_.vertices.size() &&
                          std::all_of(mesh_.vertex_colours.begin(), mesh_.vertex_colours.end(),
                                      [](const Eigen::Vector3d& c) { return c.allFinite(); });
    if (coloured) {
      array(
          "color3f[] primvars:displayColor", mesh_.vertices.size(),
          [&](std::size_t i) {
            const Eigen::Vector3d c = mesh_.vertex_colours[i].cwiseMax(0.0).cwiseMin(1.0);
            add("({}, {}, {})", single(c.x()), single(c.y()), single(c.z()));
          },
          "vertex");
    }
  }

  const MeshMaterial* material_of(std::int32_t index) const {
    if (index < 0) return nullptr;
    if (static_cast<std::size_t>(index) >= mesh_.materials.size())
      fail_usda("material " + std::to_string(index) + " does not exist");
    return &mesh_.materials[static_cast<std::size_t>(index)];
  }

  template <class Group>
  void write_subset(const Group& group) {
    const auto& key = group.first;
    const std::vector<std::uint32_t>& triangles = group.second;
    const UsdaTexture* texture = find(key.first);
    const MeshMaterial* material = material_of(key.second);
    names_.push_back({});
    if (texture == nullptr && material == nullptr) return;
    std::string name = material == nullptr ? "" : material->name;
    if (texture != nullptr) name += (name.empty() ? "" : "_") + texture->name;
    names_.back() = identifier(name.empty() ? "material" : name, used_);
    add("\n        def GeomSubset \"{}\" (\n            prepend apiSchemas = [\"MaterialBindingAPI\"]\n        )\n"
        "        {{\n            uniform token elementType = \"face\"\n"
        "            uniform token familyName = \"materialBind\"\n    ",
        names_.back());
    array("int[] indices", triangles.size(), [&](std::size_t i) { add("{}", triangles[i]); });
    add("            rel material:binding = </{}/Materials/{}>\n        }}\n", root_, names_.back());
  }

  void write_materials() {
    add("\n    def Scope \"Materials\"\n    {{\n");
    std::size_t i = 0;
    for (const auto& [key, triangles] : groups_) {
      const std::string& name = names_[i++];
      if (!name.empty()) write_material(name, find(key.first), material_of(key.second));
    }
    add("    }}\n");
  }

  void image(const std::string& path, const char* name, const std::string& file, const char* reader,
             const std::string& scale, const std::string& bias, const char* output) {
    add("            def Shader \"{}\"\n            {{\n                uniform token info:id = \"UsdUVTexture\"\n",
        name);
    add("                asset inputs:file = {}\n", asset_path(file));
    add("                float2 inputs:st.connect = <{}/{}.outputs:result>\n", path, reader);
    add("                token inputs:wrapS = \"repeat\"\n                token inputs:wrapT = \"repeat\"\n");
    if (!scale.empty()) {
      add("                token inputs:sourceColorSpace = \"raw\"\n");
      add("                float4 inputs:scale = {}\n                float4 inputs:bias = {}\n", scale, bias);
    }
    add("                {}\n            }}\n", output);
  }

  void reader(const char* name, const char* primvar) {
    add("            def Shader \"{}\"\n            {{\n"
        "                uniform token info:id = \"UsdPrimvarReader_float2\"\n"
        "                string inputs:varname = \"{}\"\n                float2 outputs:result\n            }}\n",
        name, primvar);
  }

  void write_material(const std::string& name, const UsdaTexture* texture, const MeshMaterial* material) {
    const std::string path = "/" + root_ + "/Materials/" + name;
    const bool rubs = texture != nullptr && texture->friction.has_value();
    const bool height = texture != nullptr && !texture->height_file.empty();
    const bool normal = texture != nullptr && !texture->normal_file.empty();
    const bool colour_map = material != nullptr && !material->base_colour_map.empty() && own_coordinates_;
    add("        def Material \"{}\"{}\n        {{\n", name,
        rubs ? " (\n            prepend apiSchemas = [\"PhysicsMaterialAPI\"]\n        )" : "");
    if (rubs) {
      const double sticking = *texture->friction * texture->static_friction_ratio.value_or(1.0);
      add("            float physics:dynamicFriction = {}\n            float physics:staticFriction = {}\n",
          single(*texture->friction), single(sticking));
    }
    if (texture != nullptr && texture->stiffness_N_per_m)
      add("            custom double asperity:stiffness_N_per_m = {}\n", number_text(*texture->stiffness_N_per_m));
    if (texture != nullptr && !texture->warning.empty())
      add("            custom string asperity:warning = {}\n", quoted(texture->warning));
    add("            token outputs:surface.connect = <{}/surface.outputs:surface>\n", path);
    if (height) add("            token outputs:displacement.connect = <{}/surface.outputs:displacement>\n", path);
    add("            def Shader \"surface\"\n            {{\n"
        "                uniform token info:id = \"UsdPreviewSurface\"\n");
    if (colour_map) {
      add("                color3f inputs:diffuseColor.connect = <{}/colour.outputs:rgb>\n", path);
    } else if (material != nullptr && material->base_colour) {
      const Eigen::Vector3d c = material->base_colour->cwiseMax(0.0).cwiseMin(1.0);
      add("                color3f inputs:diffuseColor = ({}, {}, {})\n", single(c.x()), single(c.y()), single(c.z()));
    }
    if (normal) add("                normal3f inputs:normal.connect = <{}/normal.outputs:rgb>\n", path);
    if (height) add("                float inputs:displacement.connect = <{}/height.outputs:r>\n", path);
    add("                float inputs:roughness = 0.5\n                token outputs:displacement\n"
        "                token outputs:surface\n            }}\n");
    if (colour_map) {
      reader("st", "st");
      image(path, "colour", material->base_colour_map, "st", "", "", "float3 outputs:rgb");
    }
    if (height || normal) reader("haptic", "haptic");
    if (normal)
      image(path, "normal", texture->normal_file, "haptic", "(2, 2, 2, 1)", "(-1, -1, -1, 0)", "float3 outputs:rgb");
    if (height) {
      image(path, "height", texture->height_file, "haptic",
            fmt::format("({}, 1, 1, 1)", single(texture->white_m - texture->black_m)),
            fmt::format("({}, 0, 0, 0)", single(texture->black_m)), "float outputs:r");
    }
    add("        }}\n");
  }

  const MeshFile& mesh_;
  double unit_m_;
  const std::vector<UsdaTexture>& textures_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::uint32_t>> groups_;
  std::string root_;
  std::set<std::string> used_;
  std::vector<std::string> names_;  // of the groups' materials; empty: none
  bool own_coordinates_ = false;
  std::string out_;
};

}  // namespace

std::string format_usda(const std::string& name, const MeshFile& mesh, double unit_m,
                        const std::vector<UsdaTexture>& textures) {
  return UsdaWriter(name, mesh, unit_m, textures).write();
}

}  // namespace asperity
