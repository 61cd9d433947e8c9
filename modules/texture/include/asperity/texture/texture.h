#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "asperity/texture/texture_models.h"

namespace asperity {

// What a texture was made from and by.
struct TextureSource {
  std::string recording;
  std::string config_json;  // the resolved config; empty if unknown
  std::string version;
};

// A haptic texture, the content of a *.texture.json and of the image or table that it names.
struct Texture {
  std::string name;
  TextureModel model;

  std::optional<double> compliance_kc;                      // k_c, within 0 and 1 (seed §5.3)
  std::optional<double> stiffness_N_per_m;                  // overrides the scene's
  std::optional<double> friction;                           // coefficient; overrides the scene's
  std::optional<double> lift_m;                             // added to the height (erratum 20)
  std::map<std::string, double> roughness;                  // by name: Ra_m, Rq_m, RSm_m, Rsk, …
  std::optional<std::array<double, 2>> band_cycles_per_mm;  // low, high
  TextureSource source;
  std::string extra_json = "{}";

  std::string_view model_name() const { return kTextureModelNames[model.index()]; }
};

}  // namespace asperity
