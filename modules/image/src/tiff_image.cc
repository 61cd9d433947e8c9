#include "asperity/image/tiff_image.h"

#include "asperity/base/error.h"
#include "asperity/base/load_library.h"
#include "asperity/base/version.h"
#include "tiff_library.h"

namespace asperity {

namespace {

const TiffLibrary& load_tiff_library() {
  const TiffLibrary* (*entry)() = nullptr;
  load_library("TIFF: libtiff's part of this program", own_library_paths("libasperity_tiff.so"),
               {library_symbol("asperity_tiff", entry)});
  const TiffLibrary* const table = entry();
  if (table->program != std::string_view(kVersion) || table->compiler != std::string_view(__VERSION__)) {
    throw Error(std::string("TIFF: libasperity_tiff.so is asperity ") + table->program + " by compiler " +
                table->compiler + ", this program is " + kVersion + " by " __VERSION__ "; install both again");
  }
  return *table;
}

}  // namespace

bool is_tiff(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv) || bytes.starts_with("II+\0"sv) ||
         bytes.starts_with("MM\0+"sv);
}

TiffImage parse_tiff(std::string_view bytes, const std::string& name) {
  if (!is_tiff(bytes)) throw Error(name + ": is not a TIFF");
  static const TiffLibrary& library = load_tiff_library();
  return library.parse(bytes, name);
}

}  // namespace asperity
