#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/texture/texture.h"

namespace asperity {

// A file in the folder of a *.texture.json that names it: an image or a table.
struct TexturePayload {
  std::string file;
  std::string content;
};

struct TextureFiles {
  std::string json;
  std::vector<TexturePayload> payloads;
};

// The content of a *.texture.json (docs/texture.md), keys always in the same order, numbers so that
// they read back exactly, and of the files that it names: `stem` and an ending of the model. Throws
// Error for a number that is not finite, a name that is not UTF-8, or a model that is not whole
// (coefficients of unequal count, …).
TextureFiles format_texture_files(const Texture& texture, const std::string& stem);
// The JSON alone, payloads called "texture.…".
std::string format_texture(const Texture& texture);
// What the payloads of a texture file are called after: x for x.texture.json and x.json.
std::string texture_stem(const std::filesystem::path& path);
// Writes both, payloads first, each under a temporary name and renamed; payloads are called after `path`:
// those of x.texture.json are x.heights.png, x.surface.csv, ….
void write_texture(const std::filesystem::path& path, const Texture& texture);

// Reads a *.texture.json of format version 1. Throws Error naming file, line and key for JSON that is
// broken, nested deeper than 32 or with a key twice; for a key that the format does not have (outside
// `extra`), a wrong type or a number out of range; for an ω that is not 2π / L within 1e-4; for a model
// or version that this program does not know; for more than 65536 coefficients or 16 MiB; for a payload
// that is not in the same folder or not what the block says. `seen` is given all that is read: the file's bytes, then
// its payload's. Throws Cancelled while the JSON is read if `observer` says so.
Texture read_texture(const std::filesystem::path& path, const std::function<void(std::string_view)>& seen = {},
                     const Observer& observer = {});

// Gives the content of a payload by the name that the block has for it: a plain file name.
using PayloadReader = std::function<std::string(const std::string& file)>;

// The same from text in memory; `name` is what messages call it. Without `payload`, a model that has one
// is refused.
Texture parse_texture(std::string_view text, const std::string& name, const PayloadReader& payload = {},
                      const Observer& observer = {});

}  // namespace asperity
