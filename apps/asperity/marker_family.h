#pragma once

#include <filesystem>
#include <string>

#include "asperity/printing/marker_sheets.h"

namespace asperity::app {

// The pictures of a family by its name (asperity/tracking/detect_tags.h). Throws Error for one that is not known.
TagFamily open_family(const std::string& name);

// The name of `family` in a markers.json in `folder`: a dictionary's file is named from there. Throws Error if it does
// not lie in that folder or one within, for a body's file reaches no other.
std::string family_beside(const std::string& family, const std::filesystem::path& folder);

}  // namespace asperity::app
