#pragma once

#include <string>

#include "asperity/scene/scene.h"
#include "asperity/texture/texture.h"

namespace asperity {

// Lays another texture in the place of that with `index` in the first object (thesis §5.4: "a texture may be
// transferred from one object to another"). Mesh and coordinates stay as they are: coordinates are lengths on the
// surface, so the texture keeps its own scale and spectrum. An index that only the mesh knows is given its
// texture. Throws Error for an index that neither the scene nor the mesh has.
void swap_texture(Scene& scene, int index, Texture texture, const std::string& file);

}  // namespace asperity
