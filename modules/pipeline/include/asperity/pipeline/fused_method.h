#pragma once

#include <string_view>

#include "asperity/pipeline/process_method.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"

namespace asperity {

// Both streams at once in a filter and a smoother (docs/trajectory.md), heights by ProcessConfig::profile.
struct FusedMethod {
  static constexpr std::string_view kMethodName = "fused";
  static constexpr std::string_view kMethodTitle = "ours";

  FusedConfig fused;

  template <class V>
  void visit_method(V& v) {
    v.group("fused", fused);
  }
  static ProcessMethod make_method();
};

}  // namespace asperity
