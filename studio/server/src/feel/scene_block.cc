#include "feel/scene_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kColumns = 256, kRows = 256;

// The size over which heights are drawn: a period, or the whole of what does not repeat.
struct Drawn {
  double width_m = 0.0, height_m = 0.0;
  std::size_t columns = 0, rows = 0;  // none: it has no heights
  double x0_m = 0.0, y0_m = 0.0;      // where it begins
};

Drawn drawn_of(const Texture& texture) {
  const auto window = height_window(texture.model, std::numeric_limits<std::size_t>::max());
  if (!window) return {};
  const bool is_line = line_length_mm(texture.model).has_value();
  return {window->length_m,    window->width_m, is_line ? 8 * kColumns : kColumns,
          is_line ? 1 : kRows, window->x_m,     window->y_m};
}

Json texture_head(const Texture& texture, const RenderTexture& render, const Drawn& drawn) {
  Json out;
  out["name"] = texture.name;
  out["kind"] = texture.model_name();
  out["highest_m"] = render.highest_m;
  out["lift_m"] = render.height_offset_m;
  out["x0_m"] = drawn.x0_m;
  out["y0_m"] = drawn.y0_m;
  out["width_m"] = drawn.width_m;
  out["height_m"] = drawn.height_m;
  out["kc"] = texture.compliance_kc ? Json(*texture.compliance_kc) : Json();
  out["stiffness_N_per_m"] = texture.stiffness_N_per_m ? Json(*texture.stiffness_N_per_m) : Json();
  out["friction"] = texture.friction ? Json(*texture.friction) : Json();
  return out;
}

void add_heights(BlockWriter& block, const std::string& name, const RenderTexture& texture, const Drawn& drawn) {
  std::vector<float> heights_m;
  heights_m.reserve(drawn.columns * drawn.rows);
  for (std::size_t row = 0; row < drawn.rows; ++row) {
    const double y_m = drawn.y0_m + drawn.height_m * (static_cast<double>(row) + 0.5) / static_cast<double>(drawn.rows);
    for (std::size_t column = 0; column < drawn.columns; ++column) {
      const double x_m =
          drawn.x0_m + drawn.width_m * (static_cast<double>(column) + 0.5) / static_cast<double>(drawn.columns);
      heights_m.push_back(static_cast<float>(render_height(texture, x_m, y_m).height_m));
    }
  }
  block.add(name, std::span<const float>(heights_m), {drawn.rows, drawn.columns});
}

void add_object(BlockWriter& block, const RenderObject& object, const std::string& k) {
  std::vector<float> vertices_m, xy_m;
  std::vector<std::uint32_t> triangles;
  for (const Eigen::Vector3d& vertex_m : object.mesh.vertices_m) {
    const Eigen::Vector3d p_world_m = object.T_world_mesh * vertex_m;
    for (int axis = 0; axis < 3; ++axis) vertices_m.push_back(static_cast<float>(p_world_m[axis]));
  }
  for (const auto& triangle : object.mesh.triangles) {
    for (const auto corner : triangle) triangles.push_back(static_cast<std::uint32_t>(corner));
  }
  block.add("vertices_" + k, std::span<const float>(vertices_m), {object.mesh.vertices_m.size(), 3});
  block.add("triangles_" + k, std::span<const std::uint32_t>(triangles), {object.mesh.triangles.size(), 3});
  if (object.texture.empty()) return;
  for (const auto& corners : object.texture_xy_m) {
    for (const Eigen::Vector2d& corner : corners) {
      xy_m.push_back(static_cast<float>(corner.x()));
      xy_m.push_back(static_cast<float>(corner.y()));
    }
  }
  block.add("texture_" + k, std::span<const std::int32_t>(object.texture));
  if (!xy_m.empty()) block.add("xy_" + k, std::span<const float>(xy_m), {object.texture_xy_m.size(), 6});
}

}  // namespace

BlockWriter make_scene_block(const Scene& scene, const RenderModel& model) {
  std::size_t triangles = 0;
  for (const RenderObject& object : model.objects) triangles += object.mesh.triangles.size();
  if (triangles > kMostDrawnTriangles) {
    throw Error("the scene has " + std::to_string(triangles) + " triangles, more than a browser can draw (" +
                std::to_string(kMostDrawnTriangles) + "); simplify its mesh");
  }
  BlockWriter block("feel.scene");
  block.head()["objects"] = model.objects.size();
  Json textures = Json::array();
  for (std::size_t t = 0; t < model.textures.size(); ++t) {
    const Drawn drawn = drawn_of(model.textures[t].texture);
    textures.push_back(texture_head(model.textures[t].texture, model.textures[t], drawn));
    if (drawn.columns > 0) add_heights(block, "height_" + std::to_string(t), model.textures[t], drawn);
  }
  // Which number of which object has which of them.
  Json indices = Json::array();
  std::size_t at = 0;
  for (std::size_t k = 0; k < scene.objects.size(); ++k) {
    if (scene.objects[k].mesh.haptic.empty()) continue;
    for (const SceneTexture& texture : scene.objects[k].textures) {
      Json each;
      each["object"] = k;
      each["index"] = texture.index;
      each["file"] = texture.file;
      each["texture"] = at++;
      indices.push_back(std::move(each));
    }
  }
  block.head()["textures"] = std::move(textures);
  block.head()["indices"] = std::move(indices);
  for (std::size_t k = 0; k < model.objects.size(); ++k) add_object(block, model.objects[k], std::to_string(k));
  return block;
}

}  // namespace asperity::studio
