#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// Detects by a file's first bytes, some thousand at most, whether a command has written it.
using IsOurs = std::function<bool(std::string_view begin)>;

// Throws Error if writing `file` would lose what is somebody else's: it exists as a link, a folder, a device or a pipe,
// cannot be read, is one of `inputs`, or is neither empty nor ours. To be asked before work begins.
void refuse_stranger(const std::filesystem::path& file, const IsOurs& is_ours,
                     const std::vector<std::string>& inputs = {});

// The same for files that begin with `header`.
void refuse_stranger(const std::filesystem::path& file, std::string_view header,
                     const std::vector<std::string>& inputs = {});

// True for the beginning of a *.texture.json, and of a *.scene.json.
bool begins_as_texture(std::string_view begin);
bool begins_as_scene(std::string_view begin);

// A PNG with a note behind its header that asperity wrote it, and whether one has that note.
std::string signed_png(std::string png);
bool begins_as_signed_png(std::string_view begin);

}  // namespace asperity
