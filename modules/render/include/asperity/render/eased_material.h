#pragma once

#include <cstdint>

#include "asperity/render/render_material.h"

namespace asperity {

// What the proxy remembers of the material that it touches, so that an exchange of the snapshot under a touching tip
// does not step the force. Plain data.
struct EasedMaterial {
  std::uint64_t id = 0;  // RenderModel::material_id of the step before
  bool felt = false;     // something was touched in the step before: `last` is what was felt
  RenderMaterial last;
  RenderMaterial from;   // what was felt at the exchange
  double since_s = 0.0;  // time since then
  double left = 0.0;     // how much of `from` is still felt: 1 at the exchange, 0 at its end and without one
};

}  // namespace asperity
