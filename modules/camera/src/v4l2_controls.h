#pragma once

#include <string>
#include <vector>

#include "v4l2_formats.h"

namespace asperity {

// Sets exposure, gain, white balance (for formats with colours) and focus to manual and to the given value, else to the
// present one. What cannot be locked is added to `warnings`. Throws Error for a given value outside the control's
// range.
void lock_controls(const V4l2Device& device, const V4l2Config& config, const V4l2Image& image,
                   std::vector<std::string>& warnings);

}  // namespace asperity
