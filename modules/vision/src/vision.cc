#include "asperity/vision/vision.h"

#include <string>
#include <string_view>

#include "asperity/base/load_library.h"
#include "asperity/base/version.h"

namespace asperity {

namespace {

const Vision& load_vision() {
  const Vision* (*entry)() = nullptr;
  load_library("vision: OpenCV's part of this program (Debian package asperity-vision)",
               own_library_paths("libasperity_vision.so"), {library_symbol("asperity_vision", entry)});
  const Vision* const table = entry();
  if (table->program != std::string_view(kVersion) || table->compiler != std::string_view(__VERSION__)) {
    throw Error(std::string("vision: libasperity_vision.so is asperity ") + table->program + " by compiler " +
                table->compiler + ", this program is " + kVersion + " by " __VERSION__ "; install both again");
  }
  return *table;
}

}  // namespace

const Vision& vision() {
  static const Vision& table = load_vision();
  return table;
}

}  // namespace asperity
