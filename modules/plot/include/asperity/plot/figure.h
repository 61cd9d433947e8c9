#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "asperity/plot/drawing.h"

namespace asperity {

struct FigureAxis {
  std::string label;
  bool logarithmic = false;
};

// Values over x; nan parts a line. Sizes are equal.
struct FigureCurve {
  std::string name;  // in the legend; empty: not there
  std::vector<double> x, y;
  Colour colour{};
  bool points = false;  // discs instead of a line
  bool dashed = false;
};

// The area between two curves; nan parts it.
struct FigureBand {
  std::string name;
  std::vector<double> x, low, high;
  Colour colour{};
};

struct FigurePanel {
  std::string title;
  FigureAxis x, y;
  std::vector<FigureBand> bands;  // under the curves
  std::vector<FigureCurve> curves;
  bool equal_scales = false;  // a unit is as long along y as along x
};

// Values on a grid, row by row from y = 0 upwards; nan is missing and drawn grey.
struct FigureMap {
  std::string title;
  std::size_t columns = 0, rows = 0;
  double x_spacing = 1.0, y_spacing = 1.0;
  std::vector<double> value;
  std::string x_label, y_label, value_label;
};

struct Figure {
  std::string title;
  std::string note;  // a line below the title, in red: what the reader must know first
  std::vector<std::variant<FigurePanel, FigureMap>> panels;
};

// The panels one below the other, 900 px wide. Axes run over the finite values, a logarithmic one over the positive
// ones. A line of more points than are seen is drawn by the first, lowest, highest and last of each half pixel column,
// so that no peak is lost; a band by its lowest and highest. A map of more points than pixels is drawn by the means of
// blocks. Colours of a map run from the 0.5 % to the 99.5 % quantile of its values (a spike of one point would use them
// up otherwise), and its bar says so where values are beyond. A panel without a finite value says "no values".
// Throws Error where sizes do not agree.
Drawing draw_figure(const Figure& figure);

}  // namespace asperity
