#pragma once

#include <set>
#include <string>

#include "asperity/scene/export_scene.h"

namespace asperity {

// Parts of export_scene(), which add files and problems to `out`; `stem` is the beginning of the files' names.

// The texture's name for people.
std::string texture_title(const SceneTexture& texture);

// The texture's stiffness or friction, else the scene's.
std::optional<double> stiffness_of(const Scene& scene, const Texture& texture);
std::optional<double> friction_of(const Scene& scene, const Texture& texture);

// The file's name without folder and endings; the same again gets a number.
std::string stem_of(const std::string& file, std::set<std::string>& used);

// <stem>.height.png, .normal.png and .images.json, of an area .sigma.png. Returns the maps without their images.
TextureMaps add_images(const std::string& stem, const SceneTexture& texture, const ExportConfig& config,
                       const Observer& observer, ExportResult& out);

// The texture stroked: <stem>.wav, .ahap or .haps, and for wav <stem>.sound.json.
void add_vibration(const std::string& stem, const SceneTexture& texture, ExportFormat format,
                   const ExportConfig& config, ExportResult& out);

// <stem>.hjif or .hmpg: the texture along its scan path, its stiffness and its friction.
void add_haptics(const std::string& stem, const Scene& scene, const SceneTexture& texture, ExportFormat format,
                 const ExportConfig& config, ExportResult& out);

// An object as <stem>.obj, .glb or .usda, with its textures' images; `used` are the stems that are taken.
void add_mesh_object(const std::string& stem, const Scene& scene, const SceneObject& object, ExportFormat format,
                     const ExportConfig& config, const Observer& observer, std::set<std::string>& used,
                     ExportResult& out);

}  // namespace asperity
