#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asperity/scene/scene.h"

namespace asperity {

// The text of scene.json alone. The same scene gives the same bytes.
std::string format_scene(const Scene& scene);

// A file of a scene, by its name in the scene's folder.
struct SceneFile {
  std::string name;
  std::string content;
};

// A texture's file and those that it names (texture_file.h), these first.
std::vector<SceneFile> format_texture_in_scene(const SceneTexture& texture);

// A mesh as augmented OBJ (thesis §6.3), its materials in one library beside it, this first.
std::vector<SceneFile> format_mesh_in_scene(const std::string& name, const MeshFile& mesh);

// Gives each mesh a name that ends in .obj, as it will be written, and that no other file of the scene has: a.obj
// stays, a.off beside it becomes 2-a.obj.
void name_meshes_obj(Scene& scene);

// All files of a scene: textures, material maps and meshes,
// last the scene itself, called `name`. Throws Error for a name that leads out of the folder or that two files
// share, or a mesh file that is not called *.obj.
std::vector<SceneFile> format_scene_files(const std::string& name, const Scene& scene);

// Writes these files into the folder of `path`, and `path` last. Throws Error as format_scene_files does, before
// anything is written, or if a file cannot be written.
void write_scene(const std::filesystem::path& path, const Scene& scene);

// The first of `files` whose name is taken in `folder` by something else than the same bytes.
std::optional<std::string> find_other_content(const std::filesystem::path& folder, const std::vector<SceneFile>& files);

}  // namespace asperity
