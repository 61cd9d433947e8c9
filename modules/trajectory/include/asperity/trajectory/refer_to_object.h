#pragma once

#include "asperity/geometry/motion.h"
#include "asperity/trajectory/object_motion.h"

namespace asperity {

// A tip's motion relative to an object that moves: in the result `world` is the object's frame, for positions,
// velocities, accelerations (all as an observer on the object sees them), orientations, covariances and forces. Samples
// at which the object was not seen are left out. The errors of both motions are taken as independent; the covariance
// has the object's rotation over the lever from its origin to the tip.
TipMotion refer_to_object(const TipMotion& motion, const ObjectMotion& object);

}  // namespace asperity
