#pragma once

#include <string_view>

#include "asperity/pipeline/process_method.h"

namespace asperity {

struct TrackerMethodConfig {
  double min_poses = 10.0;

  template <class V>
  void visit(V& v) {
    v.field("min_poses", min_poses, "with fewer there is no trajectory", {2.0, 1e6});
  }
};

// The tip by the tracker's poses alone, the accelerometer unused.
struct TrackerMethod {
  static constexpr std::string_view kMethodName = "tracker";
  static constexpr std::string_view kMethodTitle = "the poses alone";

  TrackerMethodConfig tracker;

  template <class V>
  void visit_method(V& v) {
    v.group("tracker", tracker);
  }
  static ProcessMethod make_method();
};

}  // namespace asperity
