#pragma once

#include "asperity/base/config.h"

namespace asperity {

// How a recording is handed to a causal method as it would have come.
struct CausalFeedConfig {
  double start_s = 0.25;
  double mounting_s = 3.0;
  double block_s = 0.02;
  double context_s = 0.25;

  template <class V>
  void visit(V& v) {
    v.field("start_s", start_s, "of poses that give the first state; the output begins after it, s", {0.05, 10.0});
    v.field("mounting_s", mounting_s, "the same where the sensor's rotation is unknown, s", {0.5, 60.0});
    v.field("block_s", block_s, "rows are cleaned in blocks of this length, s", {0.001, 1.0});
    v.field("context_s", context_s, "of rows before a block that its clock and its noise are taken from, s",
            {0.05, 10.0});
  }
};

}  // namespace asperity
