#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "asperity/base/error.h"

namespace asperity {

inline constexpr std::int64_t kFarthest_ns = std::int64_t{1} << 61;  // differences fit

// Throws Error unless `samples` has some, their t_ns rise and are within ±kFarthest_ns, and their p_m are finite.
template <class Samples>
void check_samples(const Samples& samples, const std::string& what) {
  if (samples.empty()) throw Error(what + ": it has no point");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto place = [&] { return what + ": point " + std::to_string(i) + ": "; };
    const std::int64_t t_ns = samples[i].t_ns;
    if (t_ns < -kFarthest_ns || t_ns > kFarthest_ns)
      throw Error(place() + std::to_string(t_ns) + " ns is not a valid time");
    if (i > 0 && t_ns <= samples[i - 1].t_ns) throw Error(place() + std::to_string(t_ns) + " ns: time does not rise");
    if (!samples[i].p_m.allFinite()) throw Error(place() + "its position is not finite");
  }
}

}  // namespace asperity
