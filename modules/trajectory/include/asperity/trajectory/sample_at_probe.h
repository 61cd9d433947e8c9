#pragma once

#include <Eigen/Core>

#include "asperity/geometry/motion.h"
#include "asperity/recording/recording.h"
#include "asperity/trajectory/reject_outliers.h"

namespace asperity {

// A motion that was estimated on a coarser time base, at the probe's own samples: accelerations and
// forces as the probe measured them there (gravity removed as in remove_gravity.h), positions,
// velocities and orientations interpolated. Samples that are rejected, incomplete or outside the motion's
// time are left out; force_N is nan where the sensor gave none. No covariance. Throws Error if the motion is
// empty or the sizes differ.
TipMotion sample_at_probe(const ProbeStream& probe, const Outliers& outliers, const Calibration& calibration,
                          const Eigen::Vector3d& gravity_world_mps2, const TipMotion& motion);

}  // namespace asperity
