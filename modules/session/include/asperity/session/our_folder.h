#pragma once

#include <filesystem>

#include "asperity/base/folder_content.h"

namespace asperity {

// Writes files.json into a folder: the names of all files in it. So a later run knows it for its own.
void write_listing(const std::filesystem::path& folder);

// True for a folder in which files.json names every file; otherwise with the first file that it does not name.
FolderContent is_our_folder(const std::filesystem::path& folder);

}  // namespace asperity
