#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asperity/base/areal_map.h"
#include "asperity/geometry/motion.h"
#include "asperity/plot/figure.h"
#include "asperity/profile/profile.h"
#include "asperity/profile/surface_spectrum.h"

namespace asperity::studio {

// Windows of the compliance (profile/estimate_compliance.h), and the power of the force in their ratios; nan: unknown.
struct ComplianceCurve {
  std::vector<double> force_N{}, ratio{};
  double exponent = 0.0;
  bool determined = false;
};

// A map and what it is of.
struct NamedMap {
  std::string title;
  ArealMap map;
};

// Everything that can be drawn of one result.
struct DrawnResult {
  std::string name;
  std::string invalid;  // why the measurement is invalid; empty if it is not
  std::optional<Profile> profile;
  std::optional<SurfaceSpectrum> spectrum;
  std::optional<TipMotion> path;
  std::optional<ComplianceCurve> compliance;
  std::vector<NamedMap> maps;
};

// Panels of several results; empty where none of them has it.
std::optional<FigurePanel> profile_panel(const std::vector<DrawnResult>& results, double band_sigmas);
std::optional<FigurePanel> texture_panel(const std::vector<DrawnResult>& results, double band_sigmas);
std::optional<FigurePanel> spectrum_panel(const std::vector<DrawnResult>& results);
std::optional<FigurePanel> path_panel(const std::vector<DrawnResult>& results);
std::optional<FigurePanel> compliance_panel(const std::vector<DrawnResult>& results);
FigureMap map_panel(const NamedMap& map);

}  // namespace asperity::studio
