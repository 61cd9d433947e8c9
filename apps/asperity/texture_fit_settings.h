#pragma once

#include "asperity/profile/read_heights.h"
#include "asperity/texture/texture_fit.h"

namespace asperity::app {

struct FitSettings {
  FittedModelChoice model{};
  bool whole_path = false;
  double stroke_spacing_mm = 0.0;

  template <class V>
  void visit(V& v) {
    v.choice("model", model, kFittedModelNames, "what the texture is");
    v.field("whole_path", whole_path, "fourier1d: the whole path as one series instead of its best window");
    v.field("stroke_spacing_mm", stroke_spacing_mm, "areal: how far profiles lie apart, in their order; 0: not given",
            {0.0, 1e6});
  }
};

struct TextureFitSettings {
  ReadHeightsConfig input;
  FitSettings fit;
  TextureFitOptions models;

  template <class V>
  void visit(V& v) {
    v.group("input", input);
    v.group("fit", fit);
    models.visit(v);
  }
};

}  // namespace asperity::app
