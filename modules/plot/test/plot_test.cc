#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "asperity/base/error.h"
#include "asperity/image/png_image.h"
#include "asperity/plot/colour_map.h"
#include "asperity/plot/figure.h"
#include "asperity/plot/format_drawing.h"
#include "thin_curve.h"
#include "ticks.h"

namespace asperity {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

Figure small_figure() {
  FigurePanel panel;
  panel.title = "Height <profile> & more";
  panel.x.label = "mm";
  panel.y.label = "µm";
  FigureCurve curve{"height", {0, 1, 2, 3, 4}, {0, 1, kMissing, 3, 2}, line_colour(0)};
  panel.curves.push_back(curve);
  FigureBand band{"± σ", curve.x, {-1, 0, kMissing, 2, 1}, {1, 2, kMissing, 4, 3}, line_colour(0)};
  panel.bands.push_back(band);
  FigureMap map;
  map.title = "map";
  map.columns = 3;
  map.rows = 2;
  map.value = {0, 1, 2, 3, kMissing, 5};
  Figure out;
  out.title = "a figure";
  out.panels = {panel, map};
  return out;
}

// Published values: mpl-colormaps' viridis at its ends and at 1/2 (0.127568, 0.566949, 0.550556).
TEST(Viridis, HasThePublishedColours) {
  const auto is = [](const Colour& c, int r, int g, int b) { return c.red == r && c.green == g && c.blue == b; };
  EXPECT_TRUE(is(viridis(0.0), 68, 1, 84));
  EXPECT_TRUE(is(viridis(128.0 / 255.0), 33, 145, 140));
  EXPECT_TRUE(is(viridis(1.0), 253, 231, 37));
  EXPECT_TRUE(is(viridis(-5.0), 68, 1, 84));
  EXPECT_TRUE(is(viridis(kMissing), 68, 1, 84));
}

// CIE lightness of sRGB (IEC 61966-2-1, CIE 1976).
double lightness(const Colour& c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double y = 0.2126 * linear(c.red / 255.0) + 0.7152 * linear(c.green / 255.0) + 0.0722 * linear(c.blue / 255.0);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(Viridis, LightnessRisesEvenly) {
  // From 15 to 91 over 255 steps; 8 bits round a step of 0.3 by up to 0.4.
  double before = lightness(viridis(0.0));
  for (int i = 16; i < 256; i += 16) {
    const double now = lightness(viridis(i / 255.0));
    EXPECT_NEAR(now - before, 16 * 76.0 / 255.0, 1.0) << i;
    before = now;
  }
}

TEST(Ticks, AreRoundAndInside) {
  const auto ticks = linear_ticks(-0.13, 0.42, 6);
  ASSERT_EQ(ticks.size(), 6U);
  EXPECT_EQ(ticks.front().label, "-0.1");
  EXPECT_EQ(ticks[1].label, "0");
  EXPECT_EQ(ticks.back().label, "0.4");
  EXPECT_EQ(linear_ticks(0.0, 1.0, 5).front().label, "0");
  const auto decades = decade_ticks(0.05, 20.0, 6);
  ASSERT_EQ(decades.size(), 3U);
  EXPECT_EQ(decades.front().label, "0.1");
  EXPECT_EQ(decades.back().label, "10");
  EXPECT_EQ(decade_ticks(2.0, 9.0, 5).front().label, "2");
}

TEST(ThinCurve, KeepsEveryPeak) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<DrawingPoint> points;
  for (int i = 0; i < 100'000; ++i) points.push_back({1e-3 * i, normal(random)});
  points[50'000].y_px = 1000.0;
  const auto thin = thin_curve(points);
  EXPECT_LE(thin.size(), 4U * 201U);
  double highest = 0.0;
  for (const DrawingPoint& p : thin) highest = std::max(highest, p.y_px);
  EXPECT_EQ(highest, 1000.0);
  for (std::size_t i = 1; i < thin.size(); ++i) EXPECT_LT(thin[i - 1].x_px, thin[i].x_px);
  EXPECT_EQ(thin_curve(std::vector<DrawingPoint>{{0, 1}}).size(), 1U);
}

TEST(FormatDrawing, SvgHasTheTextAndPartsTheLine) {
  const std::string svg = format_drawing(draw_figure(small_figure()), DrawingFormat::kSvg);
  EXPECT_THAT(svg, StartsWith(std::string(kSvgBegin)));
  EXPECT_THAT(svg, HasSubstr("Height &lt;profile&gt; &amp; more"));
  EXPECT_THAT(svg, HasSubstr("grey: missing"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_EQ(svg, format_drawing(draw_figure(small_figure()), DrawingFormat::kSvg));
}

TEST(FormatDrawing, PngAndPdfAreWhatTheySayAndTheSameEachTime) {
  const Drawing drawing = draw_figure(small_figure());
  const std::string png = format_drawing(drawing, DrawingFormat::kPng, 1.0);
  const GrayImage image = decode_png(png, "plot");
  EXPECT_EQ(image.width, 900);
  EXPECT_EQ(image.height, static_cast<int>(drawing.height_px));
  EXPECT_EQ(image.pixels.front(), 255);
  EXPECT_EQ(png, format_drawing(drawing, DrawingFormat::kPng, 1.0));
  const std::string pdf = format_drawing(drawing, DrawingFormat::kPdf);
  EXPECT_THAT(pdf, StartsWith("%PDF-1."));
  EXPECT_THAT(pdf.substr(0, 32), HasSubstr(std::string(kPdfMark)));
  EXPECT_THAT(pdf.substr(pdf.size() - 8), HasSubstr("%%EOF"));
  EXPECT_EQ(pdf, format_drawing(drawing, DrawingFormat::kPdf));
}

// The map's lower left value is the darkest, its upper right the lightest: rows go upwards.
TEST(DrawFigure, MapHasItsRowsUpwards) {
  Figure figure;
  FigureMap map;
  map.columns = map.rows = 2;
  map.value = {0, 1, 2, 3};
  figure.panels.emplace_back(map);
  for (const DrawnShape& shape : draw_figure(figure).shapes) {
    const auto* pixels = std::get_if<DrawnPixels>(&shape);
    if (pixels == nullptr) continue;
    EXPECT_EQ(pixels->rgb[3 * 2], viridis(0.0).red);
    EXPECT_EQ(pixels->rgb[3 * 1 + 1], viridis(1.0).green);
    return;
  }
  FAIL() << "no pixels";
}

TEST(DrawFigure, TakesWhatHasNoValuesAndRefusesWhatIsNotWhole) {
  Figure figure = small_figure();
  std::get<FigurePanel>(figure.panels[0]).curves[0].y.assign(5, kMissing);
  std::get<FigurePanel>(figure.panels[0]).bands.clear();
  EXPECT_THAT(format_drawing(draw_figure(figure), DrawingFormat::kSvg), HasSubstr("no values"));
  std::get<FigurePanel>(figure.panels[0]).curves[0].y.pop_back();
  EXPECT_THROW(draw_figure(figure), Error);
  figure = small_figure();
  std::get<FigureMap>(figure.panels[1]).value.pop_back();
  EXPECT_THROW(draw_figure(figure), Error);
  for (double constant : {0.0, 5.0}) {
    figure = small_figure();
    std::get<FigureMap>(figure.panels[1]).value.assign(6, constant);
    std::get<FigurePanel>(figure.panels[0]).curves[0].y.assign(5, constant);
    std::get<FigurePanel>(figure.panels[0]).bands.clear();
    EXPECT_THAT(format_drawing(draw_figure(figure), DrawingFormat::kSvg), Not(HasSubstr("nan")));
  }
  EXPECT_THROW(format_drawing(Drawing{}, DrawingFormat::kSvg), Error);
}

}  // namespace
}  // namespace asperity
