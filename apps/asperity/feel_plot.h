#pragma once

#include <string>
#include <vector>

namespace asperity::app {

// A rendered force over the way of a stroke, evenly spaced.
struct ForcePlot {
  std::string title;
  double from_m = 0.0;
  double spacing_m = 0.0;
  std::vector<double> force_N;   // nan: nothing there
  std::vector<double> height_m;  // of the texture, as many
};

// An SVG drawing, 900 by 300 px: the force in N over the way in mm, and below it the texture's height to the same way.
std::string force_svg(const ForcePlot& plot);

}  // namespace asperity::app
