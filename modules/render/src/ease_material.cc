#include "ease_material.h"

#include <algorithm>

#include "asperity/base/smoothstep.h"

namespace asperity {

void ease_material(const RenderModel& model, double dt_s, EasedMaterial& eased) noexcept {
  const double over_s = model.config.texture.cross_fade_s;
  const bool is_changed = model.material_id != eased.id;
  eased.id = model.material_id;
  if (!eased.felt || !(over_s > 0.0)) {
    eased.left = 0.0;
  } else if (is_changed) {
    eased.from = eased.last;
    eased.since_s = 0.0;
    eased.left = 1.0;
  } else if (eased.left > 0.0) {
    eased.since_s += std::max(dt_s, 0.0);
    eased.left = 1.0 - smoothstep(eased.since_s / over_s);
  }
}

}  // namespace asperity
