#pragma once

#include <span>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_path.h"
#include "asperity/geometry/mesh_point.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// A shortest path over a surface. It has a point at each end and one wherever it crosses an edge or passes
// a vertex; the piece from point i to i + 1 is straight and in triangle i of the path.
struct GeodesicPath {
  MeshPath path;
  bool locally_shortest = true;  // false: more detours than the limit were left to straighten
  int detours = 0;               // vertices that the first path passed on the wrong side
};

// The path over the surface between two points of a mesh, locally shortest: no small change of it is
// shorter. A first path by A* (Hart, Nilsson and Raphael 1968) over three points on each edge gives a strip
// of triangles; the strip is unfolded into the plane and the shortest path within it found exactly (funnel
// of Lee and Preparata 1984); wherever that bends round a vertex whose other side has less than π of
// surface, the strip is led round the other side and straightened again (Xin and Wang 2007). Of several
// locally shortest paths (round a hole, over a ridge) it is the one whose first path is shortest.
// Triangles are neighbours over their edges, also where more than two meet; there the path keeps the side
// it was first led to. Throws Error for a point that is not on the mesh, and if no chain of neighbours
// connects the points; Cancelled between two detours.
GeodesicPath geodesic_path(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const MeshPoint& from,
                           const MeshPoint& to, const Observer& observer = {});

// The shortest paths from each point to the next, joined. Throws Error also for fewer than two points.
GeodesicPath geodesic_path(const TriangleMesh& mesh, const MeshAdjacency& adjacency, std::span<const MeshPoint> through,
                           const Observer& observer = {});

}  // namespace asperity
