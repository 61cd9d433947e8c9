#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/printing/print_page.h"
#include "asperity/recording/calibration.h"
#include "asperity/tracking/tag_pattern.h"

namespace asperity {

inline constexpr std::array<std::string_view, 2> kPaperNames = {"a4", "letter"};
enum class Paper { kA4, kLetter };

// The tags of one family: its name, as in markers.json, and their pictures; nullopt for an id that it does not have.
struct TagFamily {
  std::string name;
  std::function<std::optional<TagPattern>(int id)> pattern;
};

// Pages to print, and where the tags then are.
struct MarkerPrint {
  std::vector<PrintPage> pages;
  std::vector<MarkerPlacement> markers;  // in the frame of the first tag, so that its pose is the identity
};

// Every page has a ruler of 100 mm along its foot and one along its left side: printers scale the two ways
// differently. All functions throw Error, saying what would fit, if something does not fit on a page, and for a family
// that lacks an id.

// Flat tags `size_m` wide (the outer edge of the black border), each within its white margin and a line to cut along,
// upright for its tag frame, with id and size below. `markers` is filled if all are on one page: the sheet is then a
// flat body.
MarkerPrint layout_tags(const TagFamily& family, const std::vector<int>& ids, double size_m, Paper paper);

struct RingConfig {
  int sides = 6;
  int first_id = 0;  // ids count up to the right, as the faces are seen from outside
  double size_m = 0.046;
  double face_m = 0.0;  // width and height of a face; 0: the tag with its white margin
};

// A prism with one tag a face, to be seen from all around (thesis §7.2): strips of faces side by side with fold lines
// (dashed) and a tab for glue, on as few pages as will do, and a polygon to cut out of cardboard twice as its ends. The
// marker frame is that of face 0's tag: x along the ring to the right, y along its axis, downwards, z inwards; the axis
// is at z = a = face / (2 tan(π/n)). Face i, θ = 2 π i / n, has
//   T_marker_tag: translation (a sin θ, 0, a (1 − cos θ)), rotation by −θ about y.
MarkerPrint layout_ring(const TagFamily& family, const RingConfig& config, Paper paper);

// A checkerboard with `columns` by `rows` inner corners, the first square black; the page lies on its side where that
// is needed.
PrintPage layout_checkerboard(int columns, int rows, double square_m, Paper paper);

// A ChArUco board of `columns` by `rows` squares as OpenCV 4.6 numbers it: the first square is black, the white ones
// hold the family's tags row by row from id 0 on.
PrintPage layout_charuco(const TagFamily& family, int columns, int rows, double square_m, double marker_m, Paper paper);

}  // namespace asperity
