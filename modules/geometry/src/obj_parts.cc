#include "obj_parts.h"

#include <algorithm>
#include <charconv>

#include "asperity/base/text.h"

namespace asperity {

void ObjParts::object() {
  part_.object = object_names_.find(lines_.rest(), [&](const std::string& name) { mesh_.objects.push_back(name); });
  changed_ = true;
}

void ObjParts::group() {
  std::string names;
  std::string_view rest = lines_.rest();
  while (!rest.empty()) {
    std::size_t length = 0;
    while (length < rest.size() && !is_blank(rest[length])) ++length;
    if (length > 0) {
      if (!names.empty()) names += ' ';
      names += rest.substr(0, length);
    }
    rest.remove_prefix(std::min(length + 1, rest.size()));
  }
  part_.group = group_names_.find(names, [&](const std::string& name) { mesh_.groups.push_back(name); });
  changed_ = true;
}

void ObjParts::material() {
  part_.material =
      material_names_.find(lines_.rest(), [&](const std::string& name) { mesh_.materials.emplace_back().name = name; });
  changed_ = true;
}

void ObjParts::smoothing() {
  const std::string_view value = lines_.rest();
  std::uint32_t number = 0;
  if (value != "off") {
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc{} || end != value.data() + value.size()) {
      lines_.fail("smoothing group '" + printable(value) + "' is neither a number nor off");
    }
  }
  part_.smoothing = number;
  changed_ = true;
}

void ObjParts::begin_triangle() {
  if (!changed_) return;
  changed_ = false;
  part_.first_triangle = static_cast<std::uint32_t>(mesh_.triangles.size());
  if (mesh_.parts.empty()) {
    MeshPart unnamed;
    unnamed.first_triangle = part_.first_triangle;
    if (part_ == unnamed) return;
    unnamed.first_triangle = 0;
    if (part_.first_triangle > 0) mesh_.parts.push_back(unnamed);
  } else {
    MeshPart same = mesh_.parts.back();
    same.first_triangle = part_.first_triangle;
    if (part_ == same) return;
  }
  mesh_.parts.push_back(part_);
}

}  // namespace asperity
