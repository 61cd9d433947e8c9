#pragma once

#include <string_view>

#include "asperity/pipeline/process_method.h"
#include "asperity/trajectory/estimate_trajectory_raw.h"

namespace asperity {

// The tracker's poses with straight lines between them, their error stated: what every other method has to beat.
// Heights as by fused, from the positions.
struct RawMethod {
  static constexpr std::string_view kMethodName = "raw";
  static constexpr std::string_view kMethodTitle = "the tracker's poses alone";

  RawTrajectoryConfig raw;

  template <class V>
  void visit_method(V& v) {
    v.group("raw", raw);
  }
  static ProcessMethod make_method();
};

}  // namespace asperity
