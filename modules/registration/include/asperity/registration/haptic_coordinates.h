#pragma once

#include <cstdint>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/geometry/covered_triangle.h"
#include "asperity/geometry/haptic_triangle.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_path.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

struct HapticCoordinatesConfig {
  int rings = 1;
  double half_width_mm = 0.0;
  double extension_mm = 1.0;
  double smoothing_mm = 3.0;
  double smoothing_edges = 1.0;
  double fit_smoothness = 0.003;
  double stretch_limit = 1.25;

  template <class V>
  void visit(V& v) {
    v.field("rings", rings, "n, rings of neighbours about the triangles that the path touches", {0, 1000});
    v.field("half_width_mm", half_width_mm, "if positive, instead of rings: triangles this near to the path",
            {0.0, 1e6});
    v.field("extension_mm", extension_mm, "the path is prolonged by this at either end", {0.0, 1e6});
    v.field("smoothing_mm", smoothing_mm, "half the length over which the path is smoothed, or", {0.0, 1e6});
    v.field("smoothing_edges", smoothing_edges, "this many edges of the mesh where that is more; both 0: not",
            {0.0, 1e3});
    v.field("fit_smoothness", fit_smoothness, "weight of smooth corrections against the fit along the path; 0: no fit",
            {0.0, 1e6});
    v.field("stretch_limit", stretch_limit, "a triangle stretched or squeezed by more is reported", {1.0, 1e3});
  }
};

// How the coordinates of one path fit it and its triangles. Stretch is a singular value of a triangle's map
// from the surface to (x, y): 1 where lengths are kept.
struct HapticWarp {
  std::size_t triangles = 0;               // that carry this path's coordinates
  double stretch_min = 1.0;                // least of their singular values
  double stretch_max = 1.0;                // greatest
  double stretch_rms = 0.0;                // RMS of their deviations from 1, by area
  std::vector<std::uint32_t> folded;       // triangles whose map is inverted
  std::vector<std::uint32_t> stretched;    // beyond `stretch_limit`
  std::vector<std::uint32_t> overlapping;  // to which two parts of the path are near
  double along_rms_m = 0.0;                // of s − x at the path's own points, x interpolated in their triangles
  double along_max_m = 0.0;
  double across_rms_m = 0.0;  // of y there: what smoothing took away
  double length_ratio = 1.0;  // length over the surface of the smoothed path, over that of s_m
};

struct HapticCoordinates {
  std::vector<HapticTriangle> triangles;  // one a triangle of the mesh
  std::vector<HapticWarp> warps;          // one a path, over all triangles near it
  std::size_t contested = 0;              // triangles near several paths; the nearest has them
  std::vector<CoveredTriangle> covered;  // of the others there: by triangle, then from the farthest path to the nearest
  Problems problems;  // "coordinates_fold", "…_stretch", "…_overlap", "…_contested", "path_jumps"
};

// Haptic texture coordinates of a mesh along registered paths (thesis §5.4, B.2; docs/haptic-coordinates.md):
// path i gets texture index i + 1; one without points gets no triangles. Triangles that the path touches, and `rings`
// rings of triangles that share a vertex with them, get for each corner x, the distance along the path (its s_m,
// negative before its start), and y, the distance across, positive along path direction × outward normal (erratum 17).
// Distances are those of shortest paths over the surface. A vertex has one coordinate for all its triangles, unless two
// parts of the path are near it. The path is smoothed, for the foot of a vertex on a noisy path is noisier
// than the path; and x, y are corrected by least squares so that, interpolated, they give s and 0 along it.
// Lengths of the mesh are metres. Throws Error for a path without length, with unequal counts, a triangle
// out of range, a number that is not finite or s_m that falls; and for points that no triangles connect.
HapticCoordinates assign_haptic_coordinates(const TriangleMesh& mesh, const MeshAdjacency& adjacency,
                                            const std::vector<MeshPath>& paths,
                                            const HapticCoordinatesConfig& config = {});

}  // namespace asperity
