#pragma once

#include <string_view>

#include "asperity/pipeline/process_method.h"
#include "asperity/trajectory/estimate_trajectory_particle.h"

namespace asperity {

// A bank of such filters over wild poses and the size of the process noise (estimate_trajectory_particle.h). Its model
// has the settings of fused, the other steps are fused's.
struct ParticleMethod {
  static constexpr std::string_view kMethodName = "particle";
  static constexpr std::string_view kMethodTitle = "many filters, causal";

  ParticleConfig particle;

  template <class V>
  void visit_method(V& v) {
    v.group("particle", particle);
  }
  static ProcessMethod make_method();
};

}  // namespace asperity
