#pragma once

#include <Eigen/Core>

#include "fit_base_shape.h"
#include "path_evidence.h"

namespace asperity {

// A surface of two principal curvatures about its vertex: over the tangent plane at u (m),
//   z = uᵀKu / (1 + √(1 − uᵀK²u)),
// exact for spheres (K = −I/R, of which the outward normal is e3) and cylinders, to the second order for any other.
struct CurvedSurface {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();          // the vertex, amid the path
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();         // columns: two tangents and the outward normal
  Eigen::Matrix2d curvature_per_m = Eigen::Matrix2d::Zero();  // K
  double rms_m = 0.0;                                         // of the coarse points
  double normal_sigma_rad = 0.0;                              // of the normals, by errors that last

  struct Foot {
    Eigen::Vector3d p_m, normal;
  };
  // The point below p along the surface's normal there.
  Foot foot(const Eigen::Vector3d& p_m) const;
};

// Whether the path comes back beside itself, further than errors that last: then it shows curvatures across itself.
bool covers_area(const PathEvidence& evidence, const BasePathConfig& config);

// Least squares over the cells of the path by the distance travelled, Gauss–Newton from `plane`.
CurvedSurface fit_curved_surface(const PlaneCandidate& plane, const PathEvidence& evidence,
                                 const BasePathConfig& config);

// Log odds against a rival that leaves `rival_rms_m`: N ln(rival/rms), N independent errors, less 3 for a plane's three
// fewer parameters (Akaike 1974), 6 for a circle's (1.5, and
// bodies of revolution are more usual). Chosen by chance, the surface follows errors that last, whose
// waves are longer than a texture's; missed, it is a texture at each reversal of a row.
double curved_log_odds(const CurvedSurface& surface, double rival_rms_m, bool rival_is_round,
                       const PathEvidence& evidence, const BasePathConfig& config);

}  // namespace asperity
