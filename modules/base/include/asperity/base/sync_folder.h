#pragma once

#include <filesystem>

namespace asperity {

// Forces the names in a folder to the disk: which files there are, not what is in them. A file system that cannot, and
// need not, is not an error. Throws Error naming the folder.
void sync_folder(const std::filesystem::path& folder);

}  // namespace asperity
