#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace asperity::app {

// The PNG, JPEG, PGM and PPM files among `paths` and directly in the folders among them, each folder's ordered by name
// with numbers by their value. Throws Error for a path that does not exist, a folder without images, or more than
// `most` files.
std::vector<std::filesystem::path> image_files(const std::vector<std::string>& paths, std::size_t most);

}  // namespace asperity::app
