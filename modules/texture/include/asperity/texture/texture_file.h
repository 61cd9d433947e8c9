#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/texture/texture.h"

namespace asperity {

// The content of a *.texture.json (docs/texture.md), keys always in the same order, numbers so that
// they read back exactly. Throws Error for a number that is not finite, a name that is not UTF-8, or
// coefficients of unequal count.
std::string format_texture(const Texture& texture);
void write_texture(const std::filesystem::path& path, const Texture& texture);

// Reads a *.texture.json of format version 1. Throws Error naming file, line and key for JSON that is
// broken, nested deeper than 32 or with a key twice; for a key that the format does not have (outside
// `extra`), a wrong type or a number out of range; for an ω that is not 2π / L within 1e-4; for a model
// or version that this program does not know; for more than 65536 coefficients or 16 MiB.
Texture read_texture(const std::filesystem::path& path);

// The same from text in memory; `name` is what messages call it.
Texture parse_texture(std::string_view text, const std::string& name);

}  // namespace asperity
