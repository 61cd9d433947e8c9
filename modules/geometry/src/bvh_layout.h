#pragma once

#include <cstddef>
#include <cstdint>

// How the tree lies in memory. Lengths are in mesh units: metres times the power of two that makes the
// mesh's longest side lie in [1, 2). Floats are relative to the mesh's centre. Plain types only, for this is
// read by files that are compiled for other instruction sets.
namespace asperity::bvh {

constexpr int kWidth = 8;
constexpr int kMaxBlocks = 2;
constexpr std::uint32_t kMaxLeaf = kWidth * kMaxBlocks;
constexpr std::uint32_t kLeafFlag = 0x80000000u;
constexpr std::uint32_t kNone = 0xffffffffu;

// Below this depth of the binary tree the builder halves by number, so that the depth stays below
// kMaxDepth, and the stack of a search is as long as the deepest tree can need.
constexpr int kSahDepth = 40;
constexpr int kMaxDepth = kSahDepth + 32;
constexpr int kStackSize = kMaxDepth * (kWidth - 1) + kWidth;

// The boxes of up to eight children, rounded outwards. No child: an empty box at infinity.
struct alignas(64) Node {
  float low[3][kWidth];
  float high[3][kWidth];
  std::uint32_t child[kWidth];  // a node's index, or kLeafFlag | where the leaf begins in the pool
  std::uint32_t parent;         // as LeafHead's
};

// Up to 16 triangles in the pool: this head and then one or two blocks. The corners are rounded to
// multiples of `unit`, a power of two of which the leaf's longest side is less than 65,535.
struct alignas(16) LeafHead {
  float origin[3];
  float unit;
  // A box turned with the triangles, in units: they lie within low <= axes (q - origin) <= high. Last places are 0.
  float axes[3][4];  // by columns; the matrix lengthens nothing
  float low[4], high[4];
  float slack;          // see bvh_leaf.h
  std::uint32_t first;  // index in faces of the first triangle
  std::uint32_t count;
  std::uint32_t parent;  // the node's index times 8 plus the place of this child; kNone: the root
};
struct alignas(16) LeafBlock {
  std::uint16_t corner[3][3][kWidth];  // corner, axis, triangle
};
constexpr std::size_t kPoolUnit = 16;  // bytes

// A triangle with its corners in ascending lexicographic order of their coordinates.
struct Face {
  std::uint32_t vertex0 : 30, corner0 : 2;  // corner: which of the mesh's triangle this is
  std::uint32_t vertex1 : 30, corner1 : 2;
  std::uint32_t vertex2 : 30, corner2 : 2;
  std::uint32_t triangle;
};
constexpr std::uint32_t kMaxVertices = 1u << 30;

// What a search reads.
struct TreeView {
  const Node* nodes;
  const unsigned char* pool;
  const Face* faces;
  const double* vertices;        // x y z, mesh units
  const std::uint32_t* leaf_of;  // of each triangle, as Node::child
  double centre[3];
  std::uint32_t root;  // as Node::child
  std::uint32_t face_count;
};

[[gnu::always_inline]] inline const LeafHead& leaf_head(const TreeView& tree, std::uint32_t child) {
  return *reinterpret_cast<const LeafHead*>(tree.pool + kPoolUnit * std::size_t{child & ~kLeafFlag});
}

// The nearest triangle so far, and where on it.
struct Nearest {
  double distance2;
  std::uint32_t slot;
  double weight[3];  // of the corners as Face has them
};

struct Hit {
  double t;
  std::uint32_t slot;
  double weight[3];
};

// The searches, compiled once for each instruction set. All lengths in mesh units.
struct Kernels {
  // The nearest triangle, ties by the smallest triangle. `radius`: those farther need not be found.
  // `guess`: the leaf to begin at, or kNone.
  void (*closest)(const TreeView&, const double* p, double radius, std::uint32_t guess, Nearest& out);
  // Writes the triangles within the radius to out, as many as there is room for; returns how many there are.
  std::size_t (*within)(const TreeView&, const double* p, double radius, std::uint32_t* out, std::size_t room);
  // The first hit in [0, t_max], ties by the smallest triangle; the direction's largest component in [1, 2).
  void (*cast_ray)(const TreeView&, const double* origin, const double* direction, double t_max, Hit& out);
};

const Kernels& sse2_kernels();
const Kernels& avx2_kernels();

}  // namespace asperity::bvh
