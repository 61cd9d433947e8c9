#include "roughness_figure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "asperity/plot/colour_map.h"
#include "asperity/profile/filter_profile.h"
#include "asperity/profile/measure_spectrum.h"

namespace asperity::app {

namespace {

constexpr double kUm = 1e6, kMm = 1e3;

// Along the line as the profile is: what filters leave out at the ends is missing there, half at either end.
FigureCurve profile_curve(const std::string& name, const std::vector<double>& height_m, std::size_t whole,
                          double spacing_m, std::size_t colour) {
  FigureCurve out;
  out.name = name;
  out.colour = line_colour(colour);
  const std::size_t first = (whole - std::min(whole, height_m.size())) / 2;
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    out.x.push_back(kMm * spacing_m * static_cast<double>(first + i));
    out.y.push_back(kUm * height_m[i]);
  }
  return out;
}

// Height over the part of the surface that is above it.
FigurePanel material_panel(const std::string& title, std::vector<double> height_m) {
  std::erase_if(height_m, [](double z) { return std::isnan(z); });
  std::sort(height_m.begin(), height_m.end(), std::greater<>());
  FigurePanel out;
  out.title = title;
  out.x.label = "material ratio, %";
  out.y.label = "height, µm";
  FigureCurve curve;
  curve.colour = line_colour(0);
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    curve.x.push_back(100.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(height_m.size()));
    curve.y.push_back(kUm * height_m[i]);
  }
  out.curves.push_back(std::move(curve));
  return out;
}

}  // namespace

Figure profile_figure(const HeightProfile& profile, const RoughnessConfig& config) {
  const FilteredProfiles filtered = filter_profile(profile.height_m, profile.spacing_m, config);
  const std::size_t whole = profile.height_m.size();
  Figure out;
  FigurePanel lines;
  lines.title = "Profiles";
  lines.x.label = "along the profile, mm";
  lines.y.label = "height, µm";
  lines.curves.push_back(profile_curve("P", filtered.primary_m, whole, profile.spacing_m, 0));
  if (config.lambda_c_mm > 0.0) {
    lines.curves.push_back(profile_curve("R", filtered.roughness_m, whole, profile.spacing_m, 1));
    if (!filtered.waviness_m.empty())
      lines.curves.push_back(profile_curve("W", filtered.waviness_m, whole, profile.spacing_m, 2));
  }
  out.panels.emplace_back(std::move(lines));
  out.panels.emplace_back(material_panel("Material ratio of R", filtered.roughness_m));
  const PowerSpectrum spectrum = measure_spectrum(profile.height_m, profile.spacing_m);
  FigurePanel density;
  density.title = "Spectrum of the heights";
  density.x = {"cycles/mm", true};
  density.y = {"µm² mm", true};
  FigureCurve curve;
  curve.colour = line_colour(0);
  for (std::size_t i = 1; i < spectrum.frequency.size(); ++i) {
    curve.x.push_back(spectrum.frequency[i]);
    curve.y.push_back(kUm * kUm * spectrum.density[i]);
  }
  density.curves.push_back(std::move(curve));
  out.panels.emplace_back(std::move(density));
  return out;
}

Figure map_figure(const ArealMap& map, const ArealTextureConfig& config) {
  const ArealMap surface = filter_surface(map, config);
  Figure out;
  FigureMap heights;
  heights.title = "Surface after its filters";
  heights.columns = surface.columns;
  heights.rows = surface.rows;
  heights.x_spacing = kMm * surface.x_spacing_m;
  heights.y_spacing = kMm * surface.y_spacing_m;
  heights.x_label = "x, mm";
  heights.y_label = "y, mm";
  heights.value_label = "height, µm";
  for (const double z : surface.height_m) heights.value.push_back(kUm * z);
  out.panels.emplace_back(std::move(heights));
  out.panels.emplace_back(material_panel("Material ratio", surface.height_m));
  return out;
}

}  // namespace asperity::app
