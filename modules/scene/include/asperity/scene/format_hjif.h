#pragma once

#include <string>

#include "asperity/scene/haptic_experience.h"

namespace asperity {

// An experience as HJIF, the interchange format of ISO/IEC 23090-31: profile Main, level 1, or 2 where a perception has
// more than 128 channels. A channel is one Curve band of type Linear; longer curves are several effects of it, each of
// which begins where the one before ended. Dates are zeros, so that the same experience gives the same bytes. The
// standard's text was not read: keys, names and limits are those that its reference software checks
// (MPEGGroup/HapticReferenceSoftware, IOJson::loadFile and semanticConformanceCheckExperience). Throws Error for a
// channel without keyframes, positions that do not rise, an amplitude outside −1 to 1, or a timescale outside 1 to
// 48000.
std::string format_hjif(const HapticExperience& experience);

}  // namespace asperity
