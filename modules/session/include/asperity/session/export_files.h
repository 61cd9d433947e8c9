#pragma once

#include <filesystem>

#include "asperity/base/progress.h"
#include "asperity/json/json.h"
#include "asperity/scene/export_scene.h"
#include "asperity/scene/scene.h"

namespace asperity {

// What is to be exported: a scene, a mesh, a texture alone, or a folder that holds one of them. A texture beside a
// result.json, area.json or registration.json that is not valid has its verdict as `warning`. Throws Error naming it.
Scene read_export_source(const std::filesystem::path& path, const Observer& observer = {});

// Adds the images that the materials of the meshes name, from the folder of the source, to an export as OBJ, glTF or
// USDA; one that cannot be read is a problem "not_exported". `source` is the path of read_export_source().
void add_material_images(const std::filesystem::path& source, const Scene& scene, ExportFormat format,
                         ExportResult& result);

// Writes the files into `folder`, beside them export.json (what was exported, warnings, what is missing), and the
// listing by which the folder is known for ours. Returns what `asperity export --json` says of files and problems.
Json write_export(const std::filesystem::path& folder, const ExportResult& result);

}  // namespace asperity
