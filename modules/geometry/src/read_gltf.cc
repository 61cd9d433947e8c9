#include "asperity/geometry/read_gltf.h"

#include <cmath>

#include <Eigen/Geometry>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "gltf_accessor.h"
#include "gltf_document.h"
#include "gltf_scene.h"
#include "load_gltf_model.h"
#include "plausible_coordinate.h"
#include "problem_counter.h"
#include "tinygltf_config.h"
#include "vertex_merger.h"

namespace asperity {

namespace {

constexpr Triangle kNoCorners{kNoIndex, kNoIndex, kNoIndex};

// The number that an object of `extras` holds under a key.
double extra_number(const tinygltf::Value& object, const char* key, double fallback) {
  if (!object.IsObject() || !object.Has(key)) return fallback;
  const tinygltf::Value& value = object.Get(key);
  return value.IsNumber() ? value.GetNumberAsDouble() : fallback;
}

class GltfReader {
 public:
  GltfReader(const tinygltf::Model& model, const GltfDocument& document, const std::string& name,
             const MeshLimits& limits)
      : model_(model),
        document_(document),
        name_(name),
        limits_(limits),
        merger_(mesh_.vertices),
        problems_(mesh_.problems) {
    mesh_.problems = document.problems;
  }

  MeshFile read() {
    materials();
    walk();
    if (mesh_.triangles.empty()) throw Error(name_ + ": holds no triangles");
    if (!mesh_.texture_corners.empty()) mesh_.texture_corners.resize(mesh_.triangles.size(), kNoCorners);
    if (!mesh_.normal_corners.empty()) mesh_.normal_corners.resize(mesh_.triangles.size(), kNoCorners);
    if (!mesh_.haptic.empty()) mesh_.haptic.resize(mesh_.triangles.size());
    return std::move(mesh_);
  }

 private:
  struct Visit {
    int node;
    Eigen::Affine3d T_scene_parent;
  };

  std::string image_of(int texture) const {
    if (texture < 0 || static_cast<std::size_t>(texture) >= model_.textures.size()) return {};
    const int image = model_.textures[static_cast<std::size_t>(texture)].source;
    if (image < 0 || static_cast<std::size_t>(image) >= document_.image_files.size()) return {};
    return document_.image_files[static_cast<std::size_t>(image)];
  }

  // A name as one line of text can hold it.
  static std::string clean(const std::string& name) {
    std::string out = printable(name, 200);
    while (!out.empty() && (out.back() == '\\' || out.back() == ' ')) out.pop_back();
    return std::string(trim(out));
  }

  void materials() {
    for (const tinygltf::Material& material : model_.materials) {
      MeshMaterial& m = mesh_.materials.emplace_back();
      m.name = clean(material.name);
      if (m.name.empty()) m.name = "material " + std::to_string(mesh_.materials.size());
      const std::vector<double>& colour = material.pbrMetallicRoughness.baseColorFactor;
      if (colour.size() >= 3) m.base_colour = Eigen::Vector3d(colour[0], colour[1], colour[2]);
      m.base_colour_map = image_of(material.pbrMetallicRoughness.baseColorTexture.index);
      m.normal_map = image_of(material.normalTexture.index);
    }
  }

  void walk() {
    std::vector<Visit> open;
    std::vector<bool> seen(model_.nodes.size(), false);
    const std::vector<int> first = gltf_roots(model_, name_);
    for (auto root = first.rbegin(); root != first.rend(); ++root) open.push_back({*root, Eigen::Affine3d::Identity()});
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const std::string place = name_ + ": node " + std::to_string(visit.node);
      if (visit.node < 0 || static_cast<std::size_t>(visit.node) >= model_.nodes.size())
        throw Error(place + " does not exist");
      const auto index = static_cast<std::size_t>(visit.node);
      if (seen[index]) throw Error(place + " has two parents or is its own ancestor");
      seen[index] = true;
      const tinygltf::Node& node = model_.nodes[index];
      const Eigen::Affine3d T_scene_node = visit.T_scene_parent * gltf_transform(node, place);
      if (!T_scene_node.matrix().allFinite()) throw Error(place + ": its transform is not finite");
      if (node.mesh >= 0) instance(node, T_scene_node, place);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        open.push_back({*child, T_scene_node});
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (seen[i] || model_.nodes[i].mesh < 0) continue;
      problems_.count("unplaced_mesh",
                      [&] { return name_ + ": node " + std::to_string(i) + " is not in the scene and left out"; });
    }
  }

  void instance(const tinygltf::Node& node, const Eigen::Affine3d& T_scene_node, const std::string& place) {
    if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size())
      throw Error(place + ": mesh " + std::to_string(node.mesh) + " does not exist");
    const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(node.mesh)];
    if (++instances_ > kMaxInstances)
      throw Error(name_ + ": more than " + std::to_string(kMaxInstances) + " nodes with meshes");
    const std::string name = clean(node.name.empty() ? mesh.name : node.name);
    std::int32_t object = -1;
    if (!name.empty()) {
      object = static_cast<std::int32_t>(mesh_.objects.size());
      mesh_.objects.push_back(name);
    }
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      const std::string what = name_ + ": mesh " + std::to_string(node.mesh) + ", primitive " + std::to_string(i);
      const tinygltf::Primitive& primitive = mesh.primitives[i];
      const bool triangles = primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN;
      if (!triangles) {
        problems_.count("points_or_lines", [&] { return what + ": points and lines are left out"; });
        continue;
      }
      if (!primitive.targets.empty())
        problems_.count("morph_targets", [&] { return what + ": morph targets are left out"; });
      begin_part(object, primitive.material, what);
      add_primitive(primitive, T_scene_node, what);
    }
  }

  void begin_part(std::int32_t object, int material, const std::string& what) {
    if (material >= 0 && static_cast<std::size_t>(material) >= mesh_.materials.size()) {
      throw Error(what + ": material " + std::to_string(material) + " does not exist");
    }
    MeshPart part;
    part.first_triangle = static_cast<std::uint32_t>(mesh_.triangles.size());
    part.object = object;
    part.material = std::max(material, -1);
    if (!mesh_.parts.empty() && mesh_.parts.back().first_triangle == part.first_triangle) mesh_.parts.pop_back();
    mesh_.parts.push_back(part);
  }

  // The corners of the primitive's triangles, as indices of its vertices.
  std::vector<Triangle> triangles_of(const tinygltf::Primitive& primitive, std::size_t vertices,
                                     const std::string& what) {
    std::vector<std::uint32_t> order;
    if (primitive.indices >= 0) {
      const GltfAccessor indices(model_, primitive.indices, 1, what + ", indices");
      if (!indices.is_unsigned()) throw Error(what + ": its indices are not unsigned whole numbers");
      require_room(indices.size(), what);
      order.resize(indices.size());
      for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = indices.index(i);
        if (order[i] >= vertices)
          throw Error(what + ": index " + std::to_string(order[i]) + " of " + std::to_string(vertices) + " vertices");
      }
    } else {
      require_room(vertices, what);
      order.resize(vertices);
      for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
    }
    return gltf_triangles(primitive.mode, order, what);
  }

  // What one node places is counted each time that it is placed.
  void require_room(std::size_t corners, const std::string& what) {
    indices_read_ += corners;
    if (indices_read_ > 3 * limits_.triangles) {
      throw Error(what + ": more than " + std::to_string(limits_.triangles) + " triangles");
    }
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Eigen::Affine3d& T_scene_node,
                     const std::string& what) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) throw Error(what + ": no POSITION");
    const GltfAccessor positions(model_, position->second, 3, what + ", POSITION");
    // Counted before equal ones are merged: normals and texture coordinates are not.
    corners_read_ += positions.size();
    if (corners_read_ > limits_.vertices)
      throw Error(what + ": more than " + std::to_string(limits_.vertices) + " vertices");
    std::vector<Triangle> triangles = triangles_of(primitive, positions.size(), what);
    if (triangles.size() > limits_.triangles - mesh_.triangles.size()) {
      throw Error(what + ": more than " + std::to_string(limits_.triangles) + " triangles");
    }
    // A mirror turns a triangle's orientation round.
    if (T_scene_node.linear().determinant() < 0.0) {
      for (Triangle& t : triangles) std::swap(t[1], t[2]);
    }
    std::vector<std::uint32_t> vertex(positions.size());
    for (std::size_t i = 0; i < vertex.size(); ++i) {
      const Eigen::Vector3d p = T_scene_node * vector3(positions, i);
      if (!p.allFinite()) throw Error(what + ": POSITION " + std::to_string(i) + " is not finite");
      if (!has_plausible_coordinates(p)) throw Error(what + ": POSITION " + std::to_string(i) + " is beyond 1e12");
      vertex[i] = merger_.add(p);
    }
    const std::size_t before = mesh_.triangles.size();
    for (const Triangle& t : triangles) mesh_.triangles.push_back({vertex[t[0]], vertex[t[1]], vertex[t[2]]});
    const tinygltf::Value haptic = haptic_of(primitive);
    for (const auto& [attribute, accessor] : primitive.attributes) {
      if (attribute == "POSITION") continue;
      if (attribute == "NORMAL") {
        const GltfAccessor normals(model_, accessor, 3, what + ", NORMAL");
        require_same(normals, positions, what);
        add_normals(normals, T_scene_node);
        add_corners(triangles, before, mesh_.normals.size() - normals.size(), mesh_.normal_corners);
      } else if (attribute == "TEXCOORD_0" && extra_number(haptic, "own_texture_coordinates", 1.0) != 0.0) {
        const GltfAccessor uv(model_, accessor, 2, what + ", TEXCOORD_0");
        require_same(uv, positions, what);
        for (std::size_t i = 0; i < uv.size(); ++i) {
          const Eigen::Vector3d uvw(uv.number(i, 0), 1.0 - uv.number(i, 1), 0.0);
          if (!uvw.allFinite()) throw Error(what + ": TEXCOORD_0 " + std::to_string(i) + " is not finite");
          mesh_.texture_coordinates.push_back(uvw);
        }
        add_corners(triangles, before, mesh_.texture_coordinates.size() - uv.size(), mesh_.texture_corners);
      } else if (attribute == "TEXCOORD_1" && haptic.IsObject()) {
        add_haptic(haptic, GltfAccessor(model_, accessor, 2, what + ", TEXCOORD_1"), positions, triangles, before,
                   what);
      } else if (attribute != "TEXCOORD_0") {
        problems_.count("attribute",
                        [&, &unread = attribute] { return what + ": " + printable(unread) + " is not read"; });
      }
    }
  }

  static Eigen::Vector3d vector3(const GltfAccessor& values, std::size_t i) {
    return {values.number(i, 0), values.number(i, 1), values.number(i, 2)};
  }

  static void require_same(const GltfAccessor& attribute, const GltfAccessor& positions, const std::string& what) {
    if (attribute.size() == positions.size()) return;
    throw Error(what + ": an attribute of " + std::to_string(attribute.size()) + " elements for " +
                std::to_string(positions.size()) + " positions");
  }

  void add_normals(const GltfAccessor& normals, const Eigen::Affine3d& T_scene_node) {
    // Normals turn by the cofactors, det(A) A⁻ᵀ, which need no inverse; a mirror changes their sign back.
    const Eigen::Matrix3d a = T_scene_node.linear();
    Eigen::Matrix3d cofactors;
    for (Eigen::Index i = 0; i < 3; ++i) cofactors.col(i) = a.col((i + 1) % 3).cross(a.col((i + 2) % 3));
    if (a.determinant() < 0.0) cofactors = -cofactors;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      Eigen::Vector3d n = cofactors * vector3(normals, i);
      n = n.allFinite() ? n.stableNormalized() : Eigen::Vector3d::Zero();
      mesh_.normals.push_back(n.allFinite() ? n : Eigen::Vector3d::Zero());
    }
  }

  static void add_corners(const std::vector<Triangle>& triangles, std::size_t before, std::size_t offset,
                          std::vector<Triangle>& corners) {
    corners.resize(before, kNoCorners);
    const auto shift = static_cast<std::uint32_t>(offset);
    for (const Triangle& t : triangles) corners.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }

  static tinygltf::Value haptic_of(const tinygltf::Primitive& primitive) {
    if (!primitive.extras.IsObject() || !primitive.extras.Has("asperity")) return {};
    return primitive.extras.Get("asperity");
  }

  void add_haptic(const tinygltf::Value& haptic, const GltfAccessor& xy, const GltfAccessor& positions,
                  const std::vector<Triangle>& triangles, std::size_t before, const std::string& what) {
    require_same(xy, positions, what);
    const double texture = extra_number(haptic, "haptic_texture", -1.0);
    const double width_mm = extra_number(haptic, "width_mm", 0.0);
    const double height_mm = extra_number(haptic, "height_mm", 0.0);
    if (!(texture >= 0.0 && texture < 2147483648.0 && texture == std::floor(texture) && width_mm > 0.0 &&
          height_mm > 0.0)) {
      throw Error(what + ": its haptic texture index or size is not a valid number");
    }
    mesh_.haptic.resize(before);
    for (const Triangle& t : triangles) {
      HapticTriangle h;
      h.texture = static_cast<std::int32_t>(texture);
      for (std::size_t k = 0; k < 3; ++k) {
        h.xy_mm[k] = {xy.number(t[k], 0) * width_mm, xy.number(t[k], 1) * height_mm};
        if (!h.xy_mm[k].allFinite()) throw Error(what + ": TEXCOORD_1 " + std::to_string(t[k]) + " is not finite");
      }
      mesh_.haptic.push_back(h);
    }
  }

  static constexpr std::size_t kMaxInstances = 100'000;

  const tinygltf::Model& model_;
  const GltfDocument& document_;
  const std::string& name_;
  const MeshLimits& limits_;
  MeshFile mesh_;
  VertexMerger merger_;
  ProblemCounter problems_;
  std::size_t instances_ = 0;
  std::size_t corners_read_ = 0;
  std::size_t indices_read_ = 0;
};

}  // namespace

MeshFile parse_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& folder,
                    const MeshLimits& limits, const Observer& observer) {
  const GltfDocument document = check_gltf(bytes, name, limits, observer);
  const tinygltf::Model model = load_gltf_model(document, name, folder, limits);
  return GltfReader(model, document, name, limits).read();
}

MeshFile read_gltf(const std::filesystem::path& path, const MeshLimits& limits, const Observer& observer) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  return parse_gltf(read_file(path, limits.file_bytes), path.string(), folder, limits, observer);
}

}  // namespace asperity
