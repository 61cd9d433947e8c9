#pragma once

#include <vector>

#include "bodies.h"
#include "paths.h"

namespace bench {

// The least standard deviations, of the points' RMS displacement and of the rotation, that any estimate of the pose can
// have from these lines with these errors: the Cramér–Rao bound at the truth, the errors' covariance known. With Σ that
// of the heights at points 1 mm apart (the slow error along the normals with its correlation, the tip's place common to
// all lines, the relief's mean common to a line, the relief and the white noise each averaged over the millimetre),
// it is the inverse of JᵀΣ⁻¹J, J = (p × n, n) (Kay 1993, §3.9). A motion that maps the body onto itself does not count.
// Infinite where the lines leave a motion open, as a line round a prism does along it.
PoseDifference pose_bound(const std::vector<LineOnMesh>& lines, const PathErrors& errors, const Symmetry& symmetry);

}  // namespace bench
