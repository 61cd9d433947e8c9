#include "asperity/scene/swap_texture.h"

#include <algorithm>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/version.h"

namespace asperity {

namespace {

// What lay there before is named, for coordinates and pose are still its own.
TextureOrigin swapped_origin(const Texture& texture, const std::optional<TextureOrigin>& before) {
  TextureOrigin out;
  out.kind = kSwappedOrigin;
  out.name = texture.name;
  out.version = kVersion;
  if (before)
    out.rest["replaced"] = before->rest.contains("replaced") ? before->rest.at("replaced") : Json(before->name);
  return out;
}

}  // namespace

void swap_texture(Scene& scene, int index, Texture texture, const std::string& file) {
  if (scene.objects.empty()) throw Error("swap: the scene has no object");
  SceneObject& object = scene.objects.front();
  const auto after = std::find_if(object.textures.begin(), object.textures.end(),
                                  [&](const SceneTexture& other) { return other.index >= index; });
  if (after != object.textures.end() && after->index == index) {
    after->origin = swapped_origin(texture, after->origin);
    after->texture = std::move(texture);
    after->file = file;
    return;
  }
  const bool known = index >= 0 && std::any_of(object.mesh.haptic.begin(), object.mesh.haptic.end(),
                                               [&](const HapticTriangle& t) { return t.texture == index; });
  if (!known) throw Error("swap: neither scene nor mesh has a texture " + std::to_string(index));
  TextureOrigin origin = swapped_origin(texture, std::nullopt);
  object.textures.insert(after, {index, file, std::move(texture), 0, std::move(origin)});
}

}  // namespace asperity
