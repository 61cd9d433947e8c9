#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "asperity/geometry/covered_triangle.h"
#include "asperity/scene/scene.h"

namespace asperity {

// Textures over one another (ADR 15): each triangle has a stack of them. The highest is in the mesh's `h` lines and is
// rendered, the others are in `covered`. Nothing that was laid is lost by what is laid over it.

enum class LayAt { kOver, kUnder };

inline constexpr int kFurthestOrder = 1'000'000'000;  // to either side; a scene.json with another one is refused

// The order with which a further texture comes over, or under, all that the object has; 0 for the first. A texture with
// the index `except` does not count. Throws Error if there is none.
int further_order(const SceneObject& object, LayAt at, int except = -1);

// Adds a texture to the object's list, in the place of the one of its index if there is one.
void put_texture(SceneObject& object, SceneTexture texture);

struct LaidTriangles {
  std::size_t over = 0;                         // triangles on which another texture was rendered before
  std::size_t under = 0;                        // triangles on which another one still is
  std::map<std::int32_t, std::size_t> covered;  // of `over`, by the index of the texture that was rendered there
};

// A texture over which others were laid.
struct CoveredTexture {
  std::int32_t index = 0;
  std::string file;                // as the object lists it; empty if it does not
  std::size_t triangles = 0;       // of it, that were covered
  std::size_t rendered_still = 0;  // of it, that nothing covers
};

// Those of `laid`, by rising index, as the object is afterwards.
std::vector<CoveredTexture> covered_textures(const SceneObject& object, const LaidTriangles& laid);

// Puts coordinates into the stacks of their triangles, those of one triangle in their given order: each over all
// textures of the same or a smaller order, under those of a greater one. A texture that the object does not list, for
// only its coordinates are known, is under all that it lists. Coordinates that the triangle already had of the same
// texture go. Throws Error for a triangle out of range and for claims that are not by rising triangle.
LaidTriangles lay_triangles(SceneObject& object, std::span<const CoveredTriangle> claims);

// Takes a texture out of the object: from its list and from all stacks; what it covered is rendered again. False if
// neither list nor mesh has it.
bool take_out_texture(SceneObject& object, int index);

// The least index above all that the object's list and coordinates have. Throws Error if there is none.
int free_texture_index(const SceneObject& object);

// A name for a further file of a scene that none of its files has: `wanted`, or with a number from `number` before it.
// The texture `except` of the first object does not count.
std::string free_file_name(const Scene& scene, const std::string& wanted, int number = 2, int except = -1);

}  // namespace asperity
