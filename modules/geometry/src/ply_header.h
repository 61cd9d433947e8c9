#pragma once

#include <bit>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;
  std::optional<PlyType> count_type;  // of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::optional<std::endian> order;  // none: ascii
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  // up to the first element
  std::size_t lines = 0;
};

// Throws Error naming the line for what is not a PLY header, or counts that the file has no bytes for.
PlyHeader parse_ply_header(std::string_view bytes, const std::string& name);

}  // namespace asperity
