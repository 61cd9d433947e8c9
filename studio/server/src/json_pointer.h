#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/json/json.h"

namespace asperity::studio {

// A position in a document: the keys and indices that lead to it from the root, written "/feel/textures/3" (RFC 6901).
using JsonPointer = std::vector<std::string>;
using JsonSteps = std::span<const std::string>;

// Throws Error if `path` is none.
JsonPointer parse_json_pointer(std::string_view path);
std::string format_json_pointer(JsonSteps pointer);

// What is there; nullptr for nothing.
const Json* find_at(const Json& tree, JsonSteps pointer);
inline Json* find_at(Json& tree, JsonSteps pointer) {
  return const_cast<Json*>(find_at(static_cast<const Json&>(tree), pointer));
}

// Sets what is at `pointer`, which is not the root; with null takes it out. In a list an index below its size
// replaces, the size or "-" appends. False if it leads nowhere: then nothing is changed.
bool set_at(Json& tree, JsonSteps pointer, const Json& value);

}  // namespace asperity::studio
