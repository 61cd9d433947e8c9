#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/progress.h"
#include "asperity/json/json.h"
#include "asperity/scene/lay_texture.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/scene.h"

namespace asperity {

// A mesh, or the scene of an earlier painting, to paint on; its meshes get names that end in .obj, as they will be
// written. `unit_m` is the length of a mesh's unit. Throws Error naming the file, and WrongUnit
// (scene/set_mesh_unit.h).
Scene read_painted_scene(const std::filesystem::path& file, std::optional<double> unit_m,
                         const Observer& observer = {});

// The texture of a file under `index`, or the next free one if negative, with a file name in the scene that nothing
// else has. Throws Error naming the file.
SceneTexture choose_texture(const Scene& scene, const std::filesystem::path& file, int index,
                            const Observer& observer = {});

// A sentence for each texture that `what`, such as "texture 2", covers, with its file and triangles.
std::vector<std::string> covered_notes(std::span<const CoveredTexture> textures, const std::string& what);

// What one stroke did, as in paint.json, but for the settings.
Json stroke_json(const PaintResult& result, const SceneObject& object, const SceneTexture& texture);

}  // namespace asperity
