#include "asperity/plot/format_drawing.h"

#include <string_view>

#include "asperity/base/error.h"
#include "asperity/base/load_library.h"
#include "asperity/base/version.h"
#include "format_svg.h"
#include "plot_library.h"

namespace asperity {

namespace {

constexpr double kLargestSide_px = 32'767.0;  // of Cairo's images

const PlotLibrary& load_plot_library() {
  const PlotLibrary* (*entry)() = nullptr;
  load_library("plot: Cairo's part of this program, which draws PNG and PDF,", own_library_paths("libasperity_plot.so"),
               {library_symbol("asperity_plot", entry)});
  const PlotLibrary* const table = entry();
  if (table->program != std::string_view(kVersion) || table->compiler != std::string_view(__VERSION__)) {
    throw Error(std::string("plot: libasperity_plot.so is asperity ") + table->program + " by compiler " +
                table->compiler + ", this program is " + kVersion + " by " __VERSION__ "; install both again");
  }
  return *table;
}

}  // namespace

std::string format_drawing(const Drawing& drawing, DrawingFormat format, double pixels_per_px) {
  const double scale = format == DrawingFormat::kPng ? pixels_per_px : 1.0;
  const auto fits = [&](double side_px) { return scale * side_px >= 1.0 && scale * side_px <= kLargestSide_px; };
  if (!fits(drawing.width_px) || !fits(drawing.height_px)) {
    throw Error("plot: " + std::to_string(scale * drawing.width_px) + " x " +
                std::to_string(scale * drawing.height_px) + " pixels: a side has 1 to 32767");
  }
  if (format == DrawingFormat::kSvg) return format_svg(drawing);
  static const PlotLibrary& library = load_plot_library();
  return format == DrawingFormat::kPng ? library.png(drawing, pixels_per_px) : library.pdf(drawing);
}

}  // namespace asperity
