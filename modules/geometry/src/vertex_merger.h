#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// Gives equal points one index, in the order of their first appearance; -0 equals 0.
class VertexMerger {
 public:
  explicit VertexMerger(std::vector<Eigen::Vector3d>& vertices) : vertices_(vertices) {}

  std::uint32_t add(const Eigen::Vector3d& point) {
    const Eigen::Vector3d key = point + Eigen::Vector3d::Zero();  // -0 + 0 is 0
    if (2 * (used_ + 1) > slots_.size()) grow();
    for (std::size_t slot = hash(key) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
      if (slots_[slot] == kFree) {
        slots_[slot] = static_cast<std::uint32_t>(vertices_.size());
        ++used_;
        vertices_.push_back(key);
        return slots_[slot];
      }
      if (vertices_[slots_[slot]] == key) return slots_[slot];
    }
  }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFFu;

  static std::uint64_t hash(const Eigen::Vector3d& key) {
    std::uint64_t h = 0;
    for (int i = 0; i < 3; ++i) {
      h = (h ^ std::bit_cast<std::uint64_t>(key[i])) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return h;
  }

  void grow() {
    std::vector<std::uint32_t> old(slots_.empty() ? 64 : 2 * slots_.size(), kFree);
    old.swap(slots_);
    for (const std::uint32_t index : old) {
      if (index == kFree) continue;
      std::size_t slot = hash(vertices_[index]) & (slots_.size() - 1);
      while (slots_[slot] != kFree) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = index;
    }
  }

  std::vector<Eigen::Vector3d>& vertices_;
  std::vector<std::uint32_t> slots_;
  std::size_t used_ = 0;
};

}  // namespace asperity
