#pragma once

#include <span>
#include <vector>

#include "asperity/profile/base_path.h"

namespace asperity {

// Arc length on an object's unloaded surface of a path that was measured `indentation_m` below it (one a sample, m,
// along the outward normal): the surface of a convex body is longer than the tip's path in it, that of a hollow one
// shorter. A curve p with unit normals n, moved outwards by δ that changes slowly, has ds' = t·d(p + δn) = ds + δ t·dn
// (t the direction of travel), so that on a body of radius R s' = s (1 + δ/R). Summed over steps of 1 mm of s, within
// which s' is a straight line of s; δ of a step is the mean over its samples in contact. Where the path turns back t
// and dn both change sign. s' rises where s does: a step that would shorten by more than half counts half.
//
// `contact` is one a sample; samples of which the indentation is not finite do not count. Throws Error if sizes differ.
std::vector<double> length_on_surface(const BasePath& path, std::span<const char> contact,
                                      std::span<const double> indentation_m);

}  // namespace asperity
