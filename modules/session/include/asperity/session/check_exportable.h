#pragma once

#include <filesystem>
#include <string_view>

#include "asperity/scene/scene.h"

namespace asperity {

// Throws Error if nothing of a source could be written as `format` (a name of kExportFormatNames, or of
// height_file_of): what the format needs, what the source holds, and the formats that this can be exported to. `scene`
// is what read_export_source() gave of it.
void check_exportable(const std::filesystem::path& source, const Scene& scene, std::string_view format);

}  // namespace asperity
