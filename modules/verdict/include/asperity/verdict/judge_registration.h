#pragma once

#include <cstddef>
#include <limits>

#include "asperity/verdict/verdict.h"

namespace asperity {

// What a registration shows of itself.
struct PoseEvidence {
  bool converged = true;
  int iterations = 0;
  std::size_t points = 0;
  std::size_t outliers = 0;  // of the points: not on the mesh
  bool ambiguous = false;    // another pose fits as well
  double rival_distance_m = 0.0;
  double rival_rotation_rad = 0.0;

  // nan: not known. Of the distances from the mesh and the guess nothing is concluded then; a pose whose errors, or
  // whose difference from the mesh's shape, are not known is refused.
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double slow_m = kUnknown;          // RMS distance from the mesh over centimetres of path
  double explained_m = kUnknown;     // of it, by all known errors of path and mesh and by the relief, RMS
  double extent_m = kUnknown;        // of the path, RMS about its mean
  double off_share = 0.0;            // of the path, that is not over the mesh: its mean over centimetres is farther
  double off_limit_m = kUnknown;     // from it than this,
  double off_m = kUnknown;           // by this in the median
  double assumed_drift_m = 0.0;      // of paths without stated errors, per axis; 0: all are stated
  double assumed_length_m = 0.0;     // over which it lasts
  bool independent_assumed = false;  // points without stated errors that are no path
  double guess_shift_m = kUnknown;
  double guess_rotation_rad = kUnknown;
  double guess_sigma_m = kUnknown;  // as the settings state it
  double guess_sigma_rad = kUnknown;
  bool guess_stated = true;  // by the user; a guess of unknown error can be wrong without the pose being so

  double sigma_m = kUnknown;     // of the points' RMS position, motions along which the mesh is its own image left out
  double sigma_rad = kUnknown;   // and of the rotation
  double slow_ratio = kUnknown;  // of the slow error that the pose needs to the stated one, standard deviations
  double slow_ratio_sigma = kUnknown;  // standard error of its logarithm
  double outlying = kUnknown;          // share of the paths that no such error explains
  double chance = kUnknown;  // that on a mesh of another object the best pose would stand out of the others as much
  double mirror_log_odds = kUnknown;   // of the mesh's mirror image to the mesh
  double mesh_scale = kUnknown;        // of the object over the mesh, at which the paths fit best
  double mesh_scale_sigma = kUnknown;  // standard error of its logarithm
  double mesh_scale_gain = kUnknown;   // of −2 log likelihood over the mesh as it is
  bool searched = true;                // other poses were looked for everywhere on the mesh
  std::size_t symmetric_copies = 0;    // of the pose, by the mesh's own symmetry
  bool symmetric_motion = false;       // the mesh is its own image along a motion that the paths leave open
};

// The verdicts on the pose of scans on a mesh, the worst first.
Verdicts judge_registration(const PoseEvidence& evidence);

}  // namespace asperity
