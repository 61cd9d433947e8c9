#pragma once

#include <cstdint>

#include "asperity/render/render_model.h"

namespace asperity {

// A hash of which material is where on the objects, and of where it fades: the same for snapshots that yield and rub
// alike, whatever the objects' poses.
std::uint64_t material_id(const RenderModel& model);

}  // namespace asperity
