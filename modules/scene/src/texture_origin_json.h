#pragma once

#include "asperity/json/json_object.h"
#include "asperity/scene/texture_origin.h"

namespace asperity {

// textures[].source: keys that the format does not have are kept. Throws Error for a wrong type.
TextureOrigin parse_texture_origin(const JsonItem& item);
Json format_texture_origin(const TextureOrigin& origin);

}  // namespace asperity
