#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "asperity/geometry/mesh_file.h"
#include "statement_lines.h"

namespace asperity {

// The place of a name in its table; a new name is added.
class NameTable {
 public:
  template <class Add>
  std::int32_t find(std::string_view name, Add&& add) {
    if (name.empty()) return -1;
    const auto [entry, is_new] = places_.try_emplace(std::string(name), static_cast<std::int32_t>(places_.size()));
    if (is_new) add(entry->first);
    return entry->second;
  }

 private:
  std::unordered_map<std::string, std::int32_t> places_;
};

// The parts of a mesh that is being read, from the statements that name what comes after them. Each function but
// begin_triangle() takes the line's statement, and throws Error, with its place, if it is malformed.
class ObjParts {
 public:
  ObjParts(const StatementLines& lines, MeshFile& mesh) : lines_(lines), mesh_(mesh) {}

  void object();
  void group();
  void material();
  void smoothing();

  // Before a triangle is added.
  void begin_triangle();

 private:
  const StatementLines& lines_;
  MeshFile& mesh_;
  NameTable object_names_, group_names_, material_names_;
  MeshPart part_;
  bool changed_ = false;
};

}  // namespace asperity
