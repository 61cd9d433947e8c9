#pragma once

#include <filesystem>
#include <string>

#include "asperity/json/json.h"
#include "asperity/texture/texture.h"

namespace asperity::studio {

// What a file of heights holds (an instrument's, a TIFF, a table: read_heights.h), for a person to look at:
//   {"kind":"profile"|"map","points":…,"missing":…,"size":TEXT,"picture":base64 of a PNG or "","note":TEXT,
//    "parameters":[{"key","value","unit"}]}
// Parameters are those of `asperity roughness` with its defaults, a value as text, "" where it is not defined. `note`
// is the reason if the picture or a parameter is missing. `spacing_m` is for files without positions; 0: not
// stated. Throws Error naming `name` for a file that cannot be read as heights.
Json look_at_surface(const std::filesystem::path& file, double spacing_m);

// The texture that `asperity texture fit` makes of it with its defaults: a series of a profile, a height map of a map.
Texture texture_of_surface(const std::filesystem::path& file, double spacing_m, const std::string& name);

}  // namespace asperity::studio
