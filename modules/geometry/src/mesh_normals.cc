#include "asperity/geometry/mesh_normals.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace asperity {
namespace {

using Eigen::Vector3d;

// A vector's direction, whatever its length; zero for zero.
Vector3d direction(const Vector3d& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !std::isfinite(largest)) return Vector3d::Zero();
  const Vector3d scaled = v / largest;
  return scaled / scaled.norm();
}

struct Facet {
  Vector3d normal = Vector3d::Zero();
  std::array<Vector3d, 3> along{};  // directions of the edges from corner e to e + 1
};

Facet facet(const TriangleMesh& mesh, const Triangle& tri) {
  Facet out;
  for (std::size_t e = 0; e < 3; ++e) {
    out.along[e] = direction(mesh.vertices_m[tri[(e + 1) % 3]] - mesh.vertices_m[tri[e]]);
  }
  // The two shorter edges' cross product would serve as well; the largest of the three sines loses least.
  Vector3d best = Vector3d::Zero();
  for (std::size_t e = 0; e < 3; ++e) {
    const Vector3d cross = out.along[e].cross(out.along[(e + 1) % 3]);
    if (cross.squaredNorm() > best.squaredNorm()) best = cross;
  }
  // A unit vector is known to a few units in the last place, so a smaller sine has no direction.
  constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
  if (best.norm() > kRounding) out.normal = best.normalized();
  return out;
}

}  // namespace

std::vector<Vector3d> facet_normals(const TriangleMesh& mesh) {
  std::vector<Vector3d> out;
  out.reserve(mesh.triangles.size());
  for (const Triangle& tri : mesh.triangles) out.push_back(facet(mesh, tri).normal);
  return out;
}

std::vector<Vector3d> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vector3d> sum(mesh.vertices_m.size(), Vector3d::Zero());
  for (const Triangle& tri : mesh.triangles) {
    const Facet f = facet(mesh, tri);
    if (f.normal.isZero(0.0)) continue;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3d& out = f.along[corner];
      const Vector3d back = -f.along[(corner + 2) % 3];
      sum[tri[corner]] += std::atan2(out.cross(back).norm(), out.dot(back)) * f.normal;
    }
  }
  // Facets turn by at most 2π about a vertex: a smaller sum is what rounding leaves of opposite normals.
  constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();
  for (Vector3d& n : sum) n = n.norm() > kRounding ? n.normalized() : Vector3d::Zero();
  return sum;
}

Vector3d interpolated_normal(const TriangleMesh& mesh, const std::vector<Vector3d>& vertex_normals,
                             std::uint32_t triangle, const Vector3d& barycentric) {
  const Triangle& tri = mesh.triangles[triangle];
  const Vector3d n = barycentric[0] * vertex_normals[tri[0]] + barycentric[1] * vertex_normals[tri[1]] +
                     barycentric[2] * vertex_normals[tri[2]];
  constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
  return n.norm() > kRounding ? n.normalized() : facet(mesh, tri).normal;
}

}  // namespace asperity
