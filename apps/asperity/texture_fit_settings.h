#pragma once

#include <array>
#include <string_view>

#include "asperity/profile/read_heights.h"
#include "asperity/texture/fit_areal.h"
#include "asperity/texture/fit_autoregressive.h"
#include "asperity/texture/fit_decaying_sinusoids.h"
#include "asperity/texture/fit_fourier1d.h"
#include "asperity/texture/fit_fourier1d_samples.h"
#include "asperity/texture/fit_fourier2d.h"
#include "asperity/texture/fit_stochastic.h"
#include "asperity/texture/import_penn.h"
#include "asperity/texture/make_height_map.h"

namespace asperity::app {

enum class FitModel { kFourier1d, kFourier2d, kHeightMap, kAreal, kStochastic, kAutoregressive, kDecayingSinusoids };
inline constexpr std::array<std::string_view, 7> kFitModelNames{
    "fourier1d", "fourier2d", "heightmap", "areal", "stochastic", "autoregressive", "decaying_sinusoids"};

struct FitSettings {
  FitModel model = FitModel::kFourier1d;
  bool whole_path = false;
  double stroke_spacing_mm = 0.0;

  template <class V>
  void visit(V& v) {
    v.choice("model", model, kFitModelNames, "what the texture is");
    v.field("whole_path", whole_path, "fourier1d: the whole path as one series instead of its best window");
    v.field("stroke_spacing_mm", stroke_spacing_mm, "areal: how far profiles lie apart, in their order; 0: not given",
            {0.0, 1e6});
  }
};

struct TextureFitSettings {
  ReadHeightsConfig input;
  FitSettings fit;
  FitFourier1dConfig fourier1d;
  FitFourier1dPathConfig path;
  FitFourier2dConfig fourier2d;
  MakeHeightMapConfig heightmap;
  FitArealConfig areal;
  FitStochasticConfig stochastic;
  FitAutoregressiveConfig autoregressive;
  ImportPennConfig penn;
  FitDecayingSinusoidsConfig decaying_sinusoids;

  template <class V>
  void visit(V& v) {
    v.group("input", input);
    v.group("fit", fit);
    v.group("fourier1d", fourier1d);
    v.group("path", path);
    v.group("fourier2d", fourier2d);
    v.group("heightmap", heightmap);
    v.group("areal", areal);
    v.group("stochastic", stochastic);
    v.group("autoregressive", autoregressive);
    v.group("penn", penn);
    v.group("decaying_sinusoids", decaying_sinusoids);
  }
};

}  // namespace asperity::app
