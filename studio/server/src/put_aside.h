#pragma once

#include <filesystem>
#include <string_view>

namespace asperity::studio {

// What a studio cannot use of a file stays next to it, under a name that nothing had: NAME.unreadable or NAME.before,
// then NAME.unreadable_2 and so on.

// Renames the file to the first free NAME.unreadable, which is returned. Throws Error if it cannot be renamed; it is
// then as it was.
std::filesystem::path put_aside(const std::filesystem::path& file);

// Writes the file's `content` to the first free NAME.before, unless one of these has the same content already. Returns
// the name. Throws Error if it cannot be written.
std::filesystem::path keep_copy(const std::filesystem::path& file, std::string_view content);

}  // namespace asperity::studio
