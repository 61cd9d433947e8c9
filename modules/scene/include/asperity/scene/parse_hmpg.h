#pragma once

#include <string>
#include <string_view>

#include "asperity/scene/haptic_experience.h"

namespace asperity {

// The experience in the bytes of an HMPG file, in the layout that format_hmpg.h states: what an experience of ours can
// hold, one linear curve of a band a channel. Positions are absolute again, effects joined; gains are in the file's
// perception unit exponent. Silent units and the layer are read over, an initialization unit may be repeated.
// Throws Error, which begins with `name`, for a file that is damaged or not in that layout, and for what an
// HapticExperience has no field for: other modalities and bands, avatars, reference devices, effect libraries,
// semantics, vertices, body parts, mixing weights other than 1, checksums. The work is proportional to the bytes.
HapticExperience parse_hmpg(std::string_view bytes, const std::string& name);

}  // namespace asperity
