#pragma once

#include <string_view>

#include "asperity/pipeline/process_method.h"

namespace asperity {

// The seed's steps with its position filter tuned by likelihood (estimate_trajectory_tuned.h), by the settings of
// `thesis`.
struct ThesisTunedMethod {
  static constexpr std::string_view kMethodName = "thesis_tuned";
  static constexpr std::string_view kMethodTitle = "the baseline, tuned";

  template <class V>
  void visit_method(V&) {}
  static ProcessMethod make_method();
};

}  // namespace asperity
