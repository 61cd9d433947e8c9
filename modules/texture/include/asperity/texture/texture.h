#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "asperity/json/json.h"
#include "asperity/texture/texture_models.h"

namespace asperity {

// What a texture was made from and by.
struct TextureSource {
  std::string recording;
  std::optional<Json> config;  // the resolved config; nullopt if unknown
  std::string version;
  std::optional<double> snr{};  // power of the surface over power of the noise in what was fitted
};

// What the fit that made a texture says of itself (extra.fit), by the model: samples, rms_error_m, problems, ….
struct TextureFitReport {
  Json metrics;
  std::size_t place = 0;  // how many members of others come before it in extra
};

// A haptic texture, the content of a *.texture.json and of the image or table that it names.
struct Texture {
  std::string name;
  TextureModel model;

  std::optional<double> compliance_kc;                      // k_c, within 0 and 1 (thesis §5.3)
  std::optional<double> stiffness_N_per_m;                  // overrides the scene's
  std::optional<double> friction;                           // coefficient; overrides the scene's
  std::optional<double> static_friction_ratio;              // coefficient of sticking over it; overrides the scene's
  std::optional<double> height_offset_m;                    // added to the height (erratum 20)
  std::optional<double> height_sigma_m;                     // standard deviation of the heights' error
  std::map<std::string, double> roughness;                  // by name: Ra_m, Rq_m, RSm_m, Rsk, …
  std::optional<std::array<double, 2>> band_cycles_per_mm;  // low, high
  TextureSource source;
  std::optional<TextureFitReport> fit;
  Json extra = Json::object();  // what others have put into extra

  std::string_view model_name() const { return kTextureModelNames[model.index()]; }
};

}  // namespace asperity
