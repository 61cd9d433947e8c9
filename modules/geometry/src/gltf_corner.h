#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace asperity {

// What distinguishes a vertex of glTF: one of every attribute.
struct GltfCorner {
  std::uint32_t vertex;
  std::uint32_t texture;
  std::uint32_t normal;
  Eigen::Vector2d haptic;

  bool operator==(const GltfCorner&) const = default;
};

struct GltfCornerHash {
  std::size_t operator()(const GltfCorner& c) const {
    std::uint64_t h = 0;
    const auto mix = [&](std::uint64_t value) {
      h = (h ^ value) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    };
    mix(c.vertex);
    mix(std::uint64_t{c.texture} << 32 | c.normal);
    mix(std::bit_cast<std::uint64_t>(c.haptic.x() + 0.0));
    mix(std::bit_cast<std::uint64_t>(c.haptic.y() + 0.0));
    return h;
  }
};

}  // namespace asperity
