#pragma once

#include <cstddef>
#include <cstdint>

namespace asperity {

// How much a mesh file may hold. A reader throws Error before it takes memory for more.
struct MeshLimits {
  std::uint64_t file_bytes = std::uint64_t{2} << 30;
  std::size_t vertices = 50'000'000;
  std::size_t triangles = 50'000'000;
  std::size_t line_bytes = 1 << 20;
  std::size_t polygon_corners = 4096;  // the time of triangulating grows with its square
};

}  // namespace asperity
