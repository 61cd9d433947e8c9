#pragma once

#include <string_view>

#include "asperity/pipeline/process_method.h"
#include "asperity/profile/make_profile_thesis.h"
#include "asperity/registration/register_thesis.h"
#include "asperity/trajectory/estimate_trajectory_thesis.h"

namespace asperity {

struct ThesisMethodConfig {
  ThesisTrajectoryConfig trajectory;
  ThesisProfileConfig profile;
  ThesisRegistrationConfig registration;

  template <class V>
  void visit(V& v) {
    v.group("trajectory", trajectory);
    v.group("profile", profile);
    v.group("registration", registration);
  }
};

// The seed's own steps (docs/thesis-method.md).
struct ThesisMethod {
  static constexpr std::string_view kMethodName = "thesis";
  static constexpr std::string_view kMethodTitle = "the baseline";

  ThesisMethodConfig thesis;

  template <class V>
  void visit_method(V& v) {
    v.group("thesis", thesis);
  }
  static ProcessMethod make_method();
};

}  // namespace asperity
