#pragma once

#include <bit>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
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
