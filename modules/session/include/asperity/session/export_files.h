#pragma once

#include <filesystem>

#include "asperity/base/progress.h"
#include "asperity/json/json.h"
#include "asperity/scene/export_scene.h"
#include "asperity/scene/scene.h"

namespace asperity {

// What is to be exported: a scene, a mesh, a texture alone, or a folder that holds one of them. Throws Error naming it.
Scene read_export_source(const std::filesystem::path& path, const Observer& observer = {});

// Writes the files into `folder`, with the listing by which it is known for ours. Returns what `asperity export --json`
// says of files and problems.
Json write_export(const std::filesystem::path& folder, const ExportResult& result);

}  // namespace asperity
