#pragma once

#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/geometry/mesh_point.h"
#include "asperity/geometry/triangle_mesh.h"
#include "surface_path.h"

namespace asperity {

// The point of a path that is nearest over the surface.
struct PathFoot {
  double distance_m = std::numeric_limits<double>::infinity();
  double s_m = 0.0;
  double across_m = 0.0;  // signed: positive along path direction × normal
  double beyond_m = 0.0;  // of the point past the foot along the path: not 0 only past an end
  bool at_start = false;  // the foot is the first piece's start
  bool at_end = false;    // or the last piece's end
  bool found = false;
};

// Nearest points over a surface on the pieces of a path. Shortest paths to them are straight lines in the
// triangles unfolded about the point asked for: a fan of windows goes out from it over edge after edge, each
// as wide as the corners let it see, until none can hold a nearer piece (exact as in Mitchell, Mount and
// Papadimitriou 1987, for paths that no vertex of more than 2π bends).
class PathFeet {
 public:
  PathFeet(const TriangleMesh& mesh, const MeshAdjacency& adjacency, const std::vector<PathPiece>& pieces);

  // Within `limit_m`, on pieces between two path lengths.
  PathFoot of_vertex(std::uint32_t vertex, double limit_m, double from_s_m = -kAny, double to_s_m = kAny) const;
  PathFoot of_point(const MeshPoint& point, double limit_m, double from_s_m = -kAny, double to_s_m = kAny) const;

  bool has_pieces_in(std::uint32_t triangle) const { return pieces_in_.contains(triangle); }
  const std::vector<PathPiece>& pieces() const { return pieces_; }

 private:
  static constexpr double kAny = std::numeric_limits<double>::infinity();
  struct Search;

  const TriangleMesh& mesh_;
  const MeshAdjacency& adjacency_;
  const std::vector<PathPiece>& pieces_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> pieces_in_;  // by triangle
};

}  // namespace asperity
