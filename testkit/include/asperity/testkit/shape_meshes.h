#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity::testkit {

// A flat rectangle in z = 0 from the origin, facing +z, of `columns` × `rows` cells; inner vertices are moved
// by up to `jitter` of a cell (below 0.25, or triangles may fold) and each cell's diagonal is random.
TriangleMesh plane_mesh(const Eigen::Vector2d& size_m, int columns, int rows, double jitter = 0.0,
                        std::uint64_t seed = 1);

// The side of a prism inscribed in a cylinder about z, open at both ends, facing outwards; `sweep_rad` below
// 2π leaves a gap. Cells are cut like the plane's, vertices stay on their lines along z.
TriangleMesh cylinder_mesh(double radius_m, double height_m, int around, int up, double sweep_rad,
                           std::uint64_t seed = 1);

// An icosahedron about the origin, each triangle cut in four `levels` times, vertices on the sphere.
TriangleMesh sphere_mesh(double radius_m, int levels);

// A closed box from the origin, `cells` cells along each edge, facing outwards.
TriangleMesh box_mesh(const Eigen::Vector3d& size_m, int cells);

}  // namespace asperity::testkit
