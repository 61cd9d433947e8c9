#pragma once

#include <array>
#include <string_view>

#include "asperity/profile/compare_profiles.h"
#include "asperity/profile/estimate_compliance.h"
#include "asperity/profile/estimate_stiffness.h"
#include "asperity/profile/find_base_path.h"
#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/make_profile.h"
#include "asperity/profile/make_profile_thesis.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/texture/fit_fourier1d.h"
#include "asperity/trajectory/estimate_trajectory_thesis.h"
#include "asperity/trajectory/fused.h"

namespace asperity {

enum class Method { kFused, kThesis };
inline constexpr std::array<std::string_view, 2> kMethodNames{"fused", "thesis"};

// The settings of all stages from a recording to a texture. `fused` and `profile` serve the method
// fused, the group `thesis` the seed's; the others serve both.
struct ProcessConfig {
  struct Thesis {
    ThesisTrajectoryConfig trajectory;
    ThesisProfileConfig profile;

    template <class V>
    void visit(V& v) {
      v.group("trajectory", trajectory);
      v.group("profile", profile);
    }
  };

  Method method = Method::kFused;
  double min_coverage = 0.5;
  FusedConfig fused;
  Thesis thesis;
  BasePathConfig base;
  ProfileConfig profile;
  RoughnessConfig roughness;
  PeriodicityConfig periodicity;
  ComplianceConfig compliance;
  StiffnessConfig stiffness;
  FitFourier1dConfig texture;
  ComparisonConfig comparison;

  template <class V>
  void visit(V& v) {
    v.choice("method", method, kMethodNames, "fused (ours) or thesis (the baseline)");
    v.field("min_coverage", min_coverage, "part of the profile without gaps below which it is not to be trusted",
            {0.0, 1.0});
    v.group("fused", fused);
    v.group("thesis", thesis);
    v.group("base", base);
    v.group("profile", profile);
    v.group("roughness", roughness);
    v.group("periodicity", periodicity);
    v.group("compliance", compliance);
    v.group("stiffness", stiffness);
    v.group("texture", texture);
    v.group("comparison", comparison);
  }
};

}  // namespace asperity
