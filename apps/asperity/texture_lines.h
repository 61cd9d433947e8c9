#pragma once

#include <string>
#include <string_view>

#include "asperity/json/json.h"

namespace asperity::app {

// One line of a texture's table for a person: "  label   value unit", for a member of describe_texture_model() or of a
// texture file. A key that has no label of its own, as of an added model, is spelt out with the unit in its ending. A
// member that is an object gives a line for each of its own.
std::string texture_line(std::string_view key, const Json& value);

}  // namespace asperity::app
