#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/progress.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/scene.h"
#include "asperity/studio/block.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

// One stroke: a texture along a path through points of the mesh.
struct Stroke {
  std::vector<Eigen::Vector3d> picks_m;  // in the mesh's frame
  std::string texture;                   // in the project
  int index = 1;                         // under which the scene knows it
};

// The textures and their target, as the document's section "paint" states.
struct Painting {
  std::string object;  // mesh or scene in the project; empty: nothing
  std::string unit;    // of a mesh alone: "mm", "0.06m"; empty: the project's
  HapticCoordinatesConfig coordinates;
  std::vector<Stroke> strokes;       // in their order
  std::map<int, std::string> swaps;  // index: the texture, in the project, that replaces the scene's
};

inline constexpr std::size_t kMostStrokes = 200;
inline constexpr std::size_t kMostPicks = 500;

// Throws Error in words for a section that is none, or holds too much.
Painting parse_painting(const Json& section);
Json first_painting();

struct PaintedStroke {
  PaintResult result;
  SceneTexture texture;
  std::string fault;  // why it could not be painted; empty: it was
};

struct PaintedScene {
  Scene scene;
  std::vector<PaintedStroke> strokes;
};

// Strokes and swaps laid on a scene one after another. One that cannot be painted is left out with its reason. Throws
// Error naming the file for textures that cannot be read, and Cancelled.
PaintedScene paint_all(Scene scene, const Painting& painting, const Project& project, const Observer& observer);

// For the browser: the mesh in metres (mesh_block.h) with, for each triangle, "texture" (index, -1: none),
// "xy_mm" [triangles, 3, 2] and "stretch" (the singular value farthest from 1, as a factor of at least 1, negative if
// it squeezes; nan without a texture) and "folded" (0, 1); for each stroke its path "path_K" [points, 3]; in
// the head, the textures and the strokes' values.
BlockWriter painted_block(const PaintedScene& painted);

}  // namespace asperity::studio
