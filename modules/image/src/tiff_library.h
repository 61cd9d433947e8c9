#pragma once

#include <string>
#include <string_view>

#include "asperity/image/tiff_image.h"

namespace asperity {

// What libtiff does for us, in a library of its own (libasperity_tiff.so) that is loaded at first use: it brings seven
// compressions along, which most runs never need. Throws Error as parse_tiff().
struct TiffLibrary {
  // Both sides must be of one build, for C++ types cross between them: kVersion, and the compiler's __VERSION__.
  const char* program;
  const char* compiler;

  TiffImage (*parse)(std::string_view bytes, const std::string& name);
};

}  // namespace asperity
