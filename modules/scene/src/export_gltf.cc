#include "export_gltf.h"

#include <utility>

#include "asperity/base/text.h"
#include "asperity/geometry/write_gltf.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {

std::string object_as_glb(const Scene& scene, const SceneObject& object, const TextureMapsConfig& images,
                          Problems& problems) {
  GltfExport out;
  out.mesh = object.mesh;
  out.unit_m = object.unit_m;
  for (const SceneTexture& texture : object.textures) {
    GltfTexture gltf;
    gltf.index = texture.index;
    gltf.name = texture.texture.name.empty() ? texture.file : texture.texture.name;
    gltf.stiffness_N_per_m =
        texture.texture.stiffness_N_per_m ? texture.texture.stiffness_N_per_m : scene.stiffness_N_per_m;
    gltf.friction = texture.texture.friction ? texture.texture.friction : scene.friction;
    if (is_height_field(texture.texture.model)) {
      TextureMaps maps = make_texture_maps(texture.texture, images);
      gltf.size_mm = maps.size_mm;
      gltf.height_range_m = maps.heights.high_m - maps.heights.low_m;
      gltf.normal_map = GltfImage{gltf.name + " normals", std::move(maps.normal_png), {}};
      gltf.height_map = GltfImage{gltf.name + " heights", std::move(maps.height_png), {}};
    } else {
      problems.push_back({"not_exported", printable(texture.file) + ": a force in time has no image", 1});
    }
    out.textures.push_back(std::move(gltf));
  }
  return format_gltf(out, GltfForm::kBinary);
}

}  // namespace asperity
