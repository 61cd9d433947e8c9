#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/base/random.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/pose.h"
#include "asperity/registration/registration_result.h"

namespace bench {

// A line over a mesh: points `kPathSpacing_m` apart on it, and the normals of their facets. Mesh frame.
inline constexpr double kPathSpacing_m = 0.25e-3;
struct LineOnMesh {
  std::vector<Eigen::Vector3d> p_m, normal;
};

enum class LineKind { kStraight, kArc, kWavy };

// From a random point straight on over the facets (as on the unfolded mesh), with a constant or a changing curvature.
LineOnMesh walk_over(const asperity::MeshSurface& surface, LineKind kind, double length_m, asperity::Random& random);

// What keeps a measured path from the line (standard deviations; lengths of exponential correlation along the path).
struct PathErrors {
  double slow_m = 0.12e-3;       // of an axis
  double slow_length_m = 20e-3;  // of the tracker's slow error
  double stated_ratio = 1.0;     // of its stated over its true standard deviation
  double white_m = 15e-6;
  double relief_m = 35e-6;
  double relief_length_m = 0.5e-3;
  double relief_mean_m = 0.0;
  Eigen::Vector3d tip_m = Eigen::Vector3d::Zero();  // error of the tip's place, marker frame
  double tip_sigma_m = 0.1e-3;                      // from which it was drawn
};

PathErrors draw_errors(asperity::Random& random);

// The path that a probe held along the normals, up to a lean of its own, measures.
asperity::MeasuredPath measure_line(const LineOnMesh& line, const PathErrors& errors,
                                    const asperity::Pose& T_world_mesh, asperity::Random& random);

}  // namespace bench
