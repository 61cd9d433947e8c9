#pragma once

#include <cstdint>
#include <string_view>

#include "asperity/geometry/mesh_file.h"
#include "statement_lines.h"

namespace asperity {

// The finite number that a word of the line spells. Throws Error, with the line's place, if it is none.
double finite_number(const StatementLines& lines, std::string_view word);

// Indices into the tables of a mesh; kNoIndex: not said.
struct ObjCorner {
  std::uint32_t vertex = kNoIndex;
  std::uint32_t texture = kNoIndex;
  std::uint32_t normal = kNoIndex;
};

// A corner of a face, "vertex/texture/normal", among what `mesh` holds so far. Throws Error, with the line's place, if
// it is malformed or names what is not there.
ObjCorner obj_corner(const StatementLines& lines, std::string_view word, const MeshFile& mesh);

}  // namespace asperity
