#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "asperity/plot/figure.h"
#include "asperity/profile/read_heights.h"

namespace asperity::studio {

enum class FigurePart { kProfile, kTexture, kSpectrum, kPath, kCompliance, kMap };
inline constexpr std::array<std::string_view, 6> kFigurePartNames{"profile", "texture",    "spectrum",
                                                                  "path",    "compliance", "map"};

struct ResultFigureConfig {
  double band_sigmas = 1.0;
  ReadHeightsConfig input;

  template <class V>
  void visit(V& v) {
    v.field("band_sigmas", band_sigmas, "half width of the bands about heights, in standard deviations", {0.0, 10.0});
    v.group("input", input);
  }
};

// What is drawn of a result, with its name in the legend.
struct FigureSource {
  std::string name;
  std::filesystem::path path;
};

struct ResultFigure {
  Figure figure;
  std::vector<FigurePart> drawn;
  std::vector<std::string> missing;  // of the parts that were asked for, what the results do not have; once each
};

// The figure of results: profile and texture with their bands, spectrum with its 95 % interval and noise floor, path in
// the plane of its largest spread, compliance windows, areal maps. A source is
//   a folder with a result.json    of process, register (of one scan) or merge
//   a folder with an area.json     of area: the map of its areal texture, and that map's standard deviation
//   a *.texture.json               of an areal texture: the same
//   any other file                 heights, as read_heights() reads them
// Several results are laid over each other in one panel, from where each begins; maps stand below each other. `parts`
// are the panels needed, all if empty. The verdict of an invalid result is the figure's note.
// Throws Error naming the file for one that cannot be read, or if none of `parts` can be drawn.
ResultFigure make_result_figure(std::span<const FigureSource> sources, std::span<const FigurePart> parts,
                                const ResultFigureConfig& config);

}  // namespace asperity::studio
