#include "bvh_build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "bvh_oriented_box.h"
#include "bvh_split.h"

namespace asperity::bvh {

namespace {

class Builder {
 public:
  Builder(const TriangleMesh& mesh, const Observer& observer) : mesh_(mesh), watch_(observer) {}

  TreeData build() {
    normalise();
    Range all = make_boxes();
    const std::size_t n = mesh_.triangles.size();
    out_.faces.reserve(n);
    out_.leaf_of.resize(n);
    out_.vertices.reserve(3 * used_);
    out_.pool.reserve(n * sizeof(LeafBlock) / kWidth / kPoolUnit * 3 / 2 + 64);
    new_vertex_.assign(mesh_.vertices_m.size(), kNone);
    out_.root = add(all, 0, kNone);
    if (out_.pool.capacity() > out_.pool.size() + out_.pool.size() / 16) out_.pool.shrink_to_fit();
    out_.nodes.shrink_to_fit();
    return std::move(out_);
  }

 private:
  void normalise();
  Range make_boxes();
  std::uint32_t add(const Range& range, int depth, std::uint32_t parent);
  std::uint32_t add_node(const Range& range, int depth, std::uint32_t parent);
  std::uint32_t add_leaf(const Range& range, std::uint32_t parent);
  void add_face(std::uint32_t triangle);
  std::array<Range, 2> split(const Range& range, int depth);

  const TriangleMesh& mesh_;
  TreeData out_;
  std::size_t used_ = 0;
  std::vector<Box> boxes_;  // of the triangles, in the order as it is being made
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> new_vertex_;
  RowWatch watch_;
};

// Checks the mesh; finds the unit of length and the centre from the vertices that triangles use.
void Builder::normalise() {
  const std::size_t count = mesh_.vertices_m.size();
  if (mesh_.triangles.empty()) throw Error("the mesh has no triangles");
  if (mesh_.triangles.size() > kNone) throw Error("the mesh has more than 2^32 - 1 triangles");
  if (count > kMaxVertices) throw Error("the mesh has more than 2^30 vertices");
  for (std::size_t i = 0; i < count; ++i)
    if (!mesh_.vertices_m[i].allFinite()) throw Error("vertex " + std::to_string(i) + " of the mesh is not finite");
  std::vector<bool> used(count);
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
    for (const auto v : mesh_.triangles[i]) {
      if (v >= count)
        throw Error("triangle " + std::to_string(i) + " of the mesh names vertex " + std::to_string(v) + " of " +
                    std::to_string(count));
      used[v] = true;
    }
  Eigen::Vector3d low = mesh_.vertices_m[mesh_.triangles[0][0]], high = low;
  for (std::size_t i = 0; i < count; ++i)
    if (used[i]) {
      ++used_;
      low = low.cwiseMin(mesh_.vertices_m[i]);
      high = high.cwiseMax(mesh_.vertices_m[i]);
    }
  // Halved, the difference of two finite numbers is finite.
  double size = (0.5 * high - 0.5 * low).maxCoeff();
  if (size == 0.0) size = 0.5 * low.cwiseAbs().maxCoeff();
  const int exponent = size > 0.0 ? std::clamp(std::ilogb(size) + 1, -1022, 1022) : 0;
  out_.to_metres = std::ldexp(1.0, exponent);
  out_.to_mesh_units = std::ldexp(1.0, -exponent);
  for (int k = 0; k < 3; ++k)
    out_.centre[k] = 0.5 * (low[k] * out_.to_mesh_units) + 0.5 * (high[k] * out_.to_mesh_units);
}

Range Builder::make_boxes() {
  const std::size_t n = mesh_.triangles.size();
  struct Corner {
    __m128 place;
  };
  std::vector<Corner> corners(mesh_.vertices_m.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    float r[3];
    for (int k = 0; k < 3; ++k) r[k] = static_cast<float>(mesh_.vertices_m[i][k] * out_.to_mesh_units - out_.centre[k]);
    corners[i].place = _mm_setr_ps(r[0], r[1], r[2], 0.0f);
  }
  boxes_.resize(n);
  order_.resize(n);
  Range all;
  all.last = static_cast<std::uint32_t>(n);
  for (std::uint32_t i = 0; i < all.last; ++i) {
    Box box;
    for (const auto v : mesh_.triangles[i]) box.add(corners[v].place);
    boxes_[i] = box;
    order_[i] = i;
    all.box.add(box);
    all.middles.add(twice_centre(box));
  }
  return all;
}

std::uint32_t Builder::add(const Range& range, int depth, std::uint32_t parent) {
  watch_.next();
  return range.count() <= kMaxLeaf ? add_leaf(range, parent) : add_node(range, depth, parent);
}

std::uint32_t Builder::add_node(const Range& range, int depth, std::uint32_t parent) {
  std::array<Range, kWidth> parts;
  std::array<int, kWidth> depths;
  parts[0] = range;
  depths[0] = depth;
  std::size_t count = 1;
  while (count < kWidth) {
    std::size_t largest = kWidth;
    float area = -1.0f;
    for (std::size_t i = 0; i < count; ++i)
      if (parts[i].count() > kMaxLeaf && parts[i].box.half_area() > area) {
        largest = i;
        area = parts[i].box.half_area();
      }
    if (largest == kWidth) break;
    const auto halves = split(parts[largest], depths[largest]);
    parts[largest] = halves[0];
    depths[count] = ++depths[largest];
    parts[count++] = halves[1];
  }

  const std::size_t index = out_.nodes.size();
  Node node{};
  node.parent = parent;
  for (std::size_t i = 0; i < kWidth; ++i) {
    alignas(16) float low[4], high[4];
    _mm_store_ps(low, parts[i].box.low);
    _mm_store_ps(high, parts[i].box.high);
    for (int k = 0; k < 3; ++k) {
      // Corners were rounded to the nearest float.
      node.low[k][i] = i < count ? low[k] - (std::abs(low[k]) * 0x1p-23f + 1e-37f) : low[k];
      node.high[k][i] = i < count ? high[k] + (std::abs(high[k]) * 0x1p-23f + 1e-37f) : high[k];
    }
    node.child[i] = kNone;
  }
  out_.nodes.push_back(node);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t child = add(parts[i], depths[i], static_cast<std::uint32_t>(index * kWidth + i));
    out_.nodes[index].child[i] = child;
  }
  return static_cast<std::uint32_t>(index);
}

std::array<Range, 2> Builder::split(const Range& range, int depth) {
  Range left, right;
  left.first = range.first;
  right.last = range.last;
  const Split best = depth < kSahDepth ? best_split(range, boxes_) : Split{};
  const auto take = [](Range& half, const Box& box) {
    half.box.add(box);
    half.middles.add(twice_centre(box));
  };
  std::uint32_t i = range.first, j = range.last;
  if (best.axis < 0) {
    // Where nothing tells them apart, or too deep: halves by number.
    j = range.first + range.count() / 2;
    for (; i < j; ++i) take(left, boxes_[i]);
    for (; i < range.last; ++i) take(right, boxes_[i]);
  } else {
    const auto is_left = [&](const Box& box) {
      alignas(16) float middle[4];
      _mm_store_ps(middle, twice_centre(box));
      return bin_of(middle[best.axis], best.low, best.scale) <= best.bin;
    };
    while (i < j) {
      if (is_left(boxes_[i])) {
        take(left, boxes_[i++]);
      } else {
        take(right, boxes_[i]);
        --j;
        std::swap(boxes_[i], boxes_[j]);
        std::swap(order_[i], order_[j]);
      }
    }
  }
  left.last = right.first = j;
  return {left, right};
}

std::uint32_t Builder::add_leaf(const Range& range, std::uint32_t parent) {
  const std::size_t at = out_.pool.size();
  if (at >= kNone - kLeafFlag || out_.nodes.size() > kNone / kWidth) throw Error("the mesh is too large for the tree");
  const std::uint32_t leaf = kLeafFlag | static_cast<std::uint32_t>(at);
  LeafHead head{};
  alignas(16) float low[4], high[4];
  _mm_store_ps(low, range.box.low);
  _mm_store_ps(high, range.box.high);
  float size = 0.0f;
  for (int k = 0; k < 3; ++k) {
    head.origin[k] = low[k] - (std::abs(low[k]) * 0x1p-23f + 1e-37f);
    size = std::max(size, high[k] + (std::abs(high[k]) * 0x1p-23f + 1e-37f) - head.origin[k]);
  }
  int exponent = 0;
  std::frexp(size / 65000.0f, &exponent);
  exponent = std::max(exponent, -40);
  head.unit = std::ldexp(1.0f, exponent);
  const double per_unit = std::ldexp(1.0, -exponent);
  head.parent = parent;
  head.first = static_cast<std::uint32_t>(out_.faces.size());
  head.count = range.count();

  std::array<LeafBlock, kMaxBlocks> block;
  double slack = 0.0;
  std::array<std::array<Eigen::Vector3d, 3>, kMaxLeaf> exact;
  // The places beyond the last triangle repeat it.
  const std::uint32_t places = kWidth * blocks(head.count);
  for (std::uint32_t i = 0; i < places; ++i) {
    const std::uint32_t triangle = order_[range.first + std::min(i, head.count - 1)];
    if (i < head.count) {
      add_face(triangle);
      out_.leaf_of[triangle] = leaf;
    }
    const Face& face = out_.faces.back();
    const std::uint32_t vertex[3] = {face.vertex0, face.vertex1, face.vertex2};
    Eigen::Vector3d corner[3];
    for (int v = 0; v < 3; ++v)
      for (int k = 0; k < 3; ++k) {
        const double r = out_.vertices[3 * vertex[v] + static_cast<std::size_t>(k)] - out_.centre[k];
        const double place = (r - static_cast<double>(head.origin[k])) * per_unit;
        if (i < head.count) exact[i][static_cast<std::size_t>(v)][k] = place;
        corner[v][k] = std::clamp(std::nearbyint(place), 0.0, 65535.0);
        block[i / kWidth].corner[v][k][i % kWidth] = static_cast<std::uint16_t>(corner[v][k]);
      }
    const Eigen::Vector3d u = corner[1] - corner[0], w = corner[2] - corner[0];
    const double length2 = std::max({u.squaredNorm(), w.squaredNorm(), (u - w).squaredNorm()});
    const double cross2 = u.cross(w).squaredNorm();
    if (cross2 > 0.0) {
      const double aspect2 = length2 * length2 / cross2;  // (length / width)^2
      slack = std::max(slack, std::min(aspect2 * aspect2 * 0x1p-44, length2 / aspect2 / (65535.0 * 65535.0)));
    }
  }
  set_oriented_box({exact.data(), head.count}, head);
  head.slack = static_cast<float>(slack * (1.0 + 1e-6)) + 0x1p-17f;

  const std::size_t head_units = sizeof(LeafHead) / kPoolUnit, block_units = sizeof(LeafBlock) / kPoolUnit;
  out_.pool.resize(at + head_units + block_units * blocks(head.count));
  std::memcpy(&out_.pool[at], &head, sizeof head);
  std::memcpy(&out_.pool[at + head_units], block.data(), sizeof(LeafBlock) * blocks(head.count));
  return leaf;
}

void Builder::add_face(std::uint32_t triangle) {
  const Triangle& corners = mesh_.triangles[triangle];
  std::array<std::uint8_t, 3> corner{0, 1, 2};
  const auto before = [&](std::uint8_t a, std::uint8_t b) {
    const auto &va = mesh_.vertices_m[corners[a]], &vb = mesh_.vertices_m[corners[b]];
    if (va.x() != vb.x()) return va.x() < vb.x();
    if (va.y() != vb.y()) return va.y() < vb.y();
    return va.z() < vb.z();
  };
  if (before(corner[1], corner[0])) std::swap(corner[0], corner[1]);
  if (before(corner[2], corner[1])) std::swap(corner[1], corner[2]);
  if (before(corner[1], corner[0])) std::swap(corner[0], corner[1]);

  std::uint32_t vertex[3];
  for (std::size_t k = 0; k < 3; ++k) {
    std::uint32_t& index = new_vertex_[corners[corner[k]]];
    if (index == kNone) {
      index = static_cast<std::uint32_t>(out_.vertices.size() / 3);
      for (const double x : mesh_.vertices_m[corners[corner[k]]]) out_.vertices.push_back(x * out_.to_mesh_units);
    }
    vertex[k] = index;
  }
  Face face{};
  face.vertex0 = vertex[0] & (kMaxVertices - 1), face.corner0 = corner[0] & 3u;
  face.vertex1 = vertex[1] & (kMaxVertices - 1), face.corner1 = corner[1] & 3u;
  face.vertex2 = vertex[2] & (kMaxVertices - 1), face.corner2 = corner[2] & 3u;
  face.triangle = triangle;
  out_.faces.push_back(face);
}

}  // namespace

TreeData build_tree(const TriangleMesh& mesh, const Observer& observer) { return Builder(mesh, observer).build(); }

}  // namespace asperity::bvh
