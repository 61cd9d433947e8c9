#pragma once

#include <string>

#include "asperity/plot/drawing.h"

namespace asperity {

// What Cairo does for us, in a library of its own (libasperity_plot.so) that is loaded at first use: it brings fonts
// and X11 along, which most runs never need. Each function throws Error where Cairo fails.
struct PlotLibrary {
  // Both sides must be of one build, for C++ types cross between them: kVersion, and the compiler's __VERSION__.
  const char* program;
  const char* compiler;

  std::string (*png)(const Drawing& drawing, double pixels_per_px);
  std::string (*pdf)(const Drawing& drawing);
};

}  // namespace asperity
