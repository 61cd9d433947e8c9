#pragma once

#include "asperity/profile/find_base_path.h"

namespace asperity {

// The base's arc length as that of the unloaded surface (length_on_surface.h): the tip goes below it by the force times
// the contact's compliance, of which `estimate_stiffness` says what the force's variation shows, and
// likely_compliance.h what is expected where that is little. Fills `indentation_m`, `indentation_sigma_m` and
// `tip_s_m`. Nothing changes on a base that is straight or a mesh, or without a force.
// `force_limited`: the sensor was at the end of its range, so that the force's variation shows nothing.
void measure_on_surface(const TipMotion& motion, const BasePathConfig& config, BasePathResult& base,
                        bool force_limited = false);

}  // namespace asperity
