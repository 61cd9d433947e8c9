#pragma once

#include <string>

#include "asperity/plot/figure.h"

namespace asperity {

// The range of an axis and where it lies on the drawing.
struct PlotScale {
  double low = 0.0, high = 1.0;
  double low_px = 0.0, high_px = 1.0;
  bool logarithmic = false;

  double px(double value) const;
};

// A panel's frame.
struct PlotBox {
  double left_px, right_px, top_px, bottom_px;
};

// Frame, ticks with grid lines, labels and title of a panel.
void draw_frame(Drawing& drawing, const PlotBox& box, const PlotScale& x, const PlotScale& y,
                const std::string& x_label, const std::string& y_label, const std::string& title, bool grid);

// A map with its frame and bar of colours; `top_px` is where its title begins. Gives where it ends.
double draw_map(Drawing& drawing, const FigureMap& map, double top_px);

// One line of text.
DrawnText text_at(double x_px, double y_px, std::string text, TextAnchor anchor);

inline constexpr double kFigureWidth_px = 900.0;
inline constexpr double kPlotLeft_px = 92.0, kPlotRight_px = 880.0;
inline constexpr double kTitle_px = 26.0, kAxis_px = 48.0;  // above and below a frame

}  // namespace asperity
