#pragma once

#include <array>
#include <string_view>

#include "asperity/profile/measure_areal_texture.h"
#include "asperity/profile/measure_profile_texture.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/profile/read_heights.h"

namespace asperity::app {

enum class Filters { kAsGiven, kAuto, kSc1, kSc2, kSc3, kSc4, kSc5 };
constexpr std::array<std::string_view, 7> kFiltersNames{"as_given", "auto", "Sc1", "Sc2", "Sc3", "Sc4", "Sc5"};

// Of a map whose file states no errors.
struct NoiseSettings {
  double rms_um = 0.0;
  double correlation_um = 0.0;

  template <class V>
  void visit(V& v) {
    v.field("rms_um", rms_um, "of the heights of an areal map, one standard deviation; 0: not known", {0.0, 1e6});
    v.field("correlation_um", correlation_um,
            "distance at which that noise is correlated by 0.2; 0: each height has its own", {0.0, 1e6});
  }
};

struct RoughnessSettings {
  ReadHeightsConfig input;
  Filters filters = Filters::kAsGiven;
  RoughnessConfig profile;
  MaterialRatioConfig material;
  ArealTextureConfig areal;
  NoiseSettings noise;

  template <class V>
  void visit(V& v) {
    v.group("input", input);
    v.choice("setting_class", filters, kFiltersNames,
             "cut-offs and sections: as given by roughness.*, of a setting class, or of that which the Ra calls for");
    v.group("roughness", profile);
    v.group("material", material);
    v.group("areal", areal);
    v.group("noise", noise);
  }
};

}  // namespace asperity::app
