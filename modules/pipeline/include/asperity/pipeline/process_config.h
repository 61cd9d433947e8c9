#pragma once

#include "asperity/pipeline/process_methods.h"
#include "asperity/pipeline/reference.h"
#include "asperity/profile/compare_profiles.h"
#include "asperity/profile/erode_profile.h"
#include "asperity/profile/estimate_compliance.h"
#include "asperity/profile/estimate_friction.h"
#include "asperity/profile/estimate_stiffness.h"
#include "asperity/profile/find_base_path.h"
#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/make_profile.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/texture/fit_fourier1d.h"

namespace asperity {

// The profile's settings and what is made of it: passes over one line merged, the surface under the tip.
struct ProcessProfileConfig : ProfileConfig {
  bool merge_passes = true;
  TipConfig tip;

  template <class V>
  void visit(V& v) {
    ProfileConfig::visit(v);
    v.field("merge_passes", merge_passes,
            "where a path is over the same line again, the heights are the passes' mean, if that lowers their error");
    v.group("tip", tip);
  }
};

// The settings of all stages from a recording to a texture: those of the methods, and those that
// serve any. `profile` is the method fused's.
struct ProcessConfig : ProcessMethods {
  Method method = ProcessMethods::method<FusedMethod>();
  Reference reference = Reference::kAuto;
  ObjectSmootherConfig object;
  double min_coverage = 0.5;
  BasePathConfig base;
  ProcessProfileConfig profile;
  RoughnessConfig roughness;
  PeriodicityConfig periodicity;
  ComplianceConfig compliance;
  StiffnessConfig stiffness;
  FrictionConfig friction;
  FitFourier1dConfig texture;
  ComparisonConfig comparison;

  template <class V>
  void visit(V& v) {
    v.choice("method", method, kMethodNames, describe());
    v.choice("reference", reference, kReferenceNames,
             "what the scan is relative to: object, where its marker body was recorded; world; auto: object if it was");
    v.field("min_coverage", min_coverage, "part of the profile without gaps below which it is invalid", {0.0, 1.0});
    visit_methods(v);
    v.group("object", object);
    v.group("base", base);
    v.group("profile", profile);
    v.group("roughness", roughness);
    v.group("periodicity", periodicity);
    v.group("compliance", compliance);
    v.group("stiffness", stiffness);
    v.group("friction", friction);
    v.group("texture", texture);
    v.group("comparison", comparison);
  }
};

}  // namespace asperity
