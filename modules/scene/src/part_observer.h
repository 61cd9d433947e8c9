#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "asperity/base/progress.h"

namespace asperity {

// For a part of a stage that leads from the fraction `from` of it to `to`: reports under the name of the stage.
inline Observer part_observer(const Observer& whole, std::string stage, double from, double to) {
  if (!whole.progress) return whole;
  return {[report = whole.progress, stage = std::move(stage), from, to](std::string_view, double fraction) {
            report(stage, from + (to - from) * fraction);
          },
          whole.cancelled};
}

}  // namespace asperity
