#include "asperity/geometry/mesh_bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "nearest_on_triangle.h"

namespace asperity {

struct MeshBvh::Tree {
  struct Node {
    Eigen::Vector3d low, high;
    std::uint32_t first, count;  // count 0: children at first and first + 1
  };
  struct Face {
    std::array<std::uint32_t, 3> vertex;  // ascending in position
    std::array<std::uint8_t, 3> corner;   // which corner of the mesh's triangle that is
    std::uint32_t triangle;
  };
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Face> faces;
  std::vector<Node> nodes;

  void split(std::uint32_t node, std::uint32_t first, std::uint32_t count);
  void improve(ClosestPoint& best, double& best2, const Face& face, const Eigen::Vector3d& p, double radius) const;
  ClosestPoint search(const Eigen::Vector3d& p, double radius, double bound2) const;
};

namespace {

bool before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

MeshBvh::MeshBvh(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
  if (mesh.triangles.empty()) throw Error("the mesh has no triangles");
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i)
    if (!mesh.vertices_m[i].allFinite()) throw Error("vertex " + std::to_string(i) + " of the mesh is not finite");
  tree_->vertices = mesh.vertices_m;
  tree_->faces.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Tree::Face face{mesh.triangles[i], {0, 1, 2}, static_cast<std::uint32_t>(i)};
    for (const auto index : face.vertex)
      if (index >= mesh.vertices_m.size())
        throw Error("triangle " + std::to_string(i) + " of the mesh names vertex " + std::to_string(index) + " of " +
                    std::to_string(mesh.vertices_m.size()));
    std::sort(face.corner.begin(), face.corner.end(), [&](auto a, auto b) {
      return before(mesh.vertices_m[mesh.triangles[i][a]], mesh.vertices_m[mesh.triangles[i][b]]);
    });
    for (std::size_t k = 0; k < 3; ++k) face.vertex[k] = mesh.triangles[i][face.corner[k]];
    tree_->faces.push_back(face);
  }
  tree_->nodes.emplace_back();
  tree_->split(0, 0, static_cast<std::uint32_t>(mesh.triangles.size()));
}

MeshBvh::~MeshBvh() = default;
MeshBvh::MeshBvh(MeshBvh&&) noexcept = default;
MeshBvh& MeshBvh::operator=(MeshBvh&&) noexcept = default;

void MeshBvh::Tree::split(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  Eigen::Vector3d low = vertices[faces[first].vertex[0]], high = low;
  for (std::uint32_t i = first; i < first + count; ++i)
    for (const auto v : faces[i].vertex) {
      low = low.cwiseMin(vertices[v]);
      high = high.cwiseMax(vertices[v]);
    }
  nodes[node] = {low, high, first, count};
  if (count <= 4) return;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const auto centre = [&](const Face& f) {
    return vertices[f.vertex[0]][axis] + vertices[f.vertex[1]][axis] + vertices[f.vertex[2]][axis];
  };
  const std::uint32_t half = count / 2;
  std::nth_element(faces.begin() + first, faces.begin() + first + half, faces.begin() + first + count,
                   [&](const Face& a, const Face& b) {
                     const double ca = centre(a), cb = centre(b);
                     return ca < cb || (ca == cb && a.triangle < b.triangle);
                   });
  const auto children = static_cast<std::uint32_t>(nodes.size());
  nodes.resize(nodes.size() + 2);
  nodes[node].first = children;
  nodes[node].count = 0;
  split(children, first, half);
  split(children + 1, first + half, count - half);
}

void MeshBvh::Tree::improve(ClosestPoint& best, double& best2, const Face& face, const Eigen::Vector3d& p,
                            double radius) const {
  const Eigen::Vector3d* v[3] = {&vertices[face.vertex[0]], &vertices[face.vertex[1]], &vertices[face.vertex[2]]};
  const auto near = bvh::nearest_on_triangle(v[0]->data(), v[1]->data(), v[2]->data(), p.data());
  if (near.distance2 > best2 || (near.distance2 == best2 && face.triangle >= best.triangle)) return;
  if (!(std::sqrt(near.distance2) <= radius)) return;
  best2 = near.distance2;
  best.triangle = face.triangle;
  best.distance_m = std::sqrt(near.distance2);
  int top = 0;
  for (int k = 0; k < 3; ++k) {
    best.barycentric[face.corner[k]] = near.weight[k];
    if (near.weight[k] > near.weight[top]) top = k;
  }
  best.p_m = *v[top];
  for (int k = 0; k < 3; ++k)
    if (k != top) best.p_m += near.weight[k] * (*v[k] - *v[top]);
}

ClosestPoint MeshBvh::Tree::search(const Eigen::Vector3d& p, double radius, double bound2) const {
  ClosestPoint best;
  double best2 = bound2;
  if (!p.allFinite() || !(radius >= 0.0)) return best;
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  const auto gap2 = [&](std::uint32_t n) {
    return (nodes[n].low - p).cwiseMax(p - nodes[n].high).cwiseMax(0.0).squaredNorm() * (1.0 - 1e-14);
  };
  while (depth > 0) {
    const Node& node = nodes[stack[--depth]];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) improve(best, best2, faces[i], p, radius);
      continue;
    }
    const double a = gap2(node.first), b = gap2(node.first + 1);
    const std::uint32_t nearer = a <= b ? node.first : node.first + 1;
    const std::uint32_t farther = a <= b ? node.first + 1 : node.first;
    if (std::max(a, b) <= best2) stack[depth++] = farther;
    if (std::min(a, b) <= best2) stack[depth++] = nearer;
  }
  return best;
}

ClosestPoint MeshBvh::closest_point(const Eigen::Vector3d& p_m, double radius_m) const noexcept {
  return tree_->search(p_m, radius_m, std::numeric_limits<double>::infinity());
}

ClosestPoint MeshBvh::closest_point(const Eigen::Vector3d& p_m, const ClosestPoint&) const noexcept {
  return closest_point(p_m);
}

RayHit MeshBvh::cast_ray(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& direction,
                         double t_max) const noexcept {
  RayHit best;
  if (!origin_m.allFinite() || !direction.allFinite() || direction.isZero(0.0) || !(t_max >= 0.0)) return best;
  int z = 0;
  direction.cwiseAbs().maxCoeff(&z);
  const int x = (z + 1) % 3, y = (z + 2) % 3;
  std::array<std::uint32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  best.t = t_max;
  while (depth > 0) {
    const auto& node = tree_->nodes[stack[--depth]];
    double enter = 0.0, leave = best.t;
    for (int k = 0; k < 3; ++k) {
      const double slack =
          1e-12 * (node.high - node.low).maxCoeff() +
          1e-14 * (origin_m.cwiseAbs().maxCoeff() + node.high.cwiseAbs().maxCoeff() + node.low.cwiseAbs().maxCoeff());
      const double low = node.low[k] - slack - origin_m[k], high = node.high[k] + slack - origin_m[k];
      if (direction[k] == 0.0) {
        if (low > 0.0 || high < 0.0) leave = -1.0;
      } else {
        enter = std::max(enter, std::min(low / direction[k], high / direction[k]));
        leave = std::min(leave, std::max(low / direction[k], high / direction[k]));
      }
    }
    if (!(enter <= leave)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto& face = tree_->faces[i];
      double vx[3], vy[3], vz[3];
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d q = tree_->vertices[face.vertex[static_cast<std::size_t>(k)]] - origin_m;
        vz[k] = q[z] / direction[z];
        vx[k] = q[x] - direction[x] * vz[k];
        vy[k] = q[y] - direction[y] * vz[k];
      }
      const double w[3] = {vx[2] * vy[1] - vy[2] * vx[1], vx[0] * vy[2] - vy[0] * vx[2], vx[1] * vy[0] - vy[1] * vx[0]};
      if (std::min({w[0], w[1], w[2]}) < 0.0 && std::max({w[0], w[1], w[2]}) > 0.0) continue;
      const double sum = w[0] + w[1] + w[2];
      if (sum == 0.0) continue;
      const double t = (w[0] * vz[0] + w[1] * vz[1] + w[2] * vz[2]) / sum;
      if (!(t >= 0.0 && t <= best.t) || (t == best.t && face.triangle >= best.triangle)) continue;
      best.t = t;
      best.triangle = face.triangle;
      for (std::size_t k = 0; k < 3; ++k) best.barycentric[face.corner[k]] = w[k] / sum;
    }
  }
  return best.found() ? best : RayHit{};
}

std::size_t MeshBvh::memory_bytes() const noexcept {
  return sizeof(Tree) + tree_->vertices.capacity() * sizeof(Eigen::Vector3d) +
         tree_->faces.capacity() * sizeof(Tree::Face) + tree_->nodes.capacity() * sizeof(Tree::Node);
}

}  // namespace asperity
