#pragma once

#include <string_view>

#include "asperity/pipeline/process_method.h"
#include "asperity/trajectory/causal_feed_config.h"

namespace asperity {

// The filter of fused alone: one pass, nothing from the future (estimate_trajectory_ekf.h). Its model has the settings
// of fused, the other steps are fused's.
struct EkfMethod {
  static constexpr std::string_view kMethodName = "ekf";
  static constexpr std::string_view kMethodTitle = "one pass, causal";

  CausalFeedConfig ekf;

  template <class V>
  void visit_method(V& v) {
    v.group("ekf", ekf);
  }
  static ProcessMethod make_method();
};

}  // namespace asperity
