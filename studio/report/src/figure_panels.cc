#include "figure_panels.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "asperity/plot/colour_map.h"

namespace asperity::studio {

namespace {

constexpr double kUm = 1e6, kMm = 1e3;
constexpr double kBandOpacity = 0.28;
constexpr Colour kGrey{0x77, 0x77, 0x77};

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> out(values);
  for (double& value : out) value *= factor;
  return out;
}

bool any_finite(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

// What a name in a legend is, of several results behind that of the result.
std::string legend(const std::vector<DrawnResult>& results, const DrawnResult& result, const std::string& what) {
  return results.size() > 1 ? result.name : what;
}

std::string sigma_text(double band_sigmas) {
  return band_sigmas == 1.0 ? std::string("± σ") : fmt::format("± {:g} σ", band_sigmas);
}

std::optional<FigurePanel> heights_panel(const std::vector<DrawnResult>& results, double band_sigmas,
                                         std::vector<double> Profile::*heights, std::vector<double> Profile::*sigmas,
                                         const std::string& title) {
  FigurePanel out;
  out.title = title;
  out.x.label = "along the path, mm";
  out.y.label = "height, µm";
  for (std::size_t k = 0; k < results.size(); ++k) {
    if (!results[k].profile) continue;
    const Profile& profile = *results[k].profile;
    const std::vector<double>& height_m = profile.*heights;
    const std::vector<double>& sigma_m = profile.*sigmas;
    if (!any_finite(height_m)) continue;
    const std::vector<double> s_mm = scaled(profile.s_m, kMm);
    if (band_sigmas > 0.0 && sigma_m.size() == height_m.size() && any_finite(sigma_m)) {
      FigureBand band{results.size() > 1 ? "" : sigma_text(band_sigmas), s_mm, {}, {}, line_colour(k)};
      band.colour.opacity = kBandOpacity;
      for (std::size_t i = 0; i < height_m.size(); ++i) {
        band.low.push_back(kUm * (height_m[i] - band_sigmas * sigma_m[i]));
        band.high.push_back(kUm * (height_m[i] + band_sigmas * sigma_m[i]));
      }
      out.bands.push_back(std::move(band));
    }
    out.curves.push_back({legend(results, results[k], "height"), s_mm, scaled(height_m, kUm), line_colour(k)});
  }
  if (out.curves.empty()) return std::nullopt;
  return out;
}

}  // namespace

std::optional<FigurePanel> profile_panel(const std::vector<DrawnResult>& results, double band_sigmas) {
  return heights_panel(results, band_sigmas, &Profile::height_m, &Profile::sigma_m, "Height profile");
}

std::optional<FigurePanel> texture_panel(const std::vector<DrawnResult>& results, double band_sigmas) {
  return heights_panel(results, band_sigmas, &Profile::texture_m, &Profile::texture_sigma_m, "Texture (high-passed)");
}

std::optional<FigurePanel> spectrum_panel(const std::vector<DrawnResult>& results) {
  constexpr double kUm2 = 1e12;  // µm² a m²
  FigurePanel out;
  out.title = "Spectrum";
  out.x = {"spatial frequency, cycles/mm", true};
  out.y = {"density, µm²·mm", true};
  for (std::size_t k = 0; k < results.size(); ++k) {
    if (!results[k].spectrum || results[k].spectrum->size() == 0) continue;
    const SurfaceSpectrum& s = *results[k].spectrum;
    if (any_finite(s.high_m2_mm)) {
      FigureBand band{results.size() > 1 ? "" : "95 %", s.frequency_cycles_per_mm, scaled(s.low_m2_mm, kUm2),
                      scaled(s.high_m2_mm, kUm2), line_colour(k)};
      band.colour.opacity = kBandOpacity;
      // An interval down to 0 ends at the axis; its upper end alone must not stretch the axis.
      out.bands.push_back(std::move(band));
    }
    out.curves.push_back({legend(results, results[k], "surface"), s.frequency_cycles_per_mm,
                          scaled(s.density_m2_mm, kUm2), line_colour(k)});
    if (any_finite(s.noise_m2_mm)) {
      FigureCurve noise{results.size() > 1 ? "" : "noise floor", s.frequency_cycles_per_mm, scaled(s.noise_m2_mm, kUm2),
                        results.size() > 1 ? line_colour(k) : kGrey};
      noise.dashed = true;
      out.curves.push_back(std::move(noise));
    }
  }
  if (out.curves.empty()) return std::nullopt;
  return out;
}

std::optional<FigurePanel> path_panel(const std::vector<DrawnResult>& results) {
  // The plane of the largest spread of all paths about each one's mean.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Vector3d> mean_m(results.size(), Eigen::Vector3d::Zero());
  for (std::size_t k = 0; k < results.size(); ++k) {
    if (!results[k].path || results[k].path->size() == 0) continue;
    const auto& points = results[k].path->p_world_tip_m;
    for (const Eigen::Vector3d& p : points) mean_m[k] += p / static_cast<double>(points.size());
    for (const Eigen::Vector3d& p : points) spread += (p - mean_m[k]) * (p - mean_m[k]).transpose();
  }
  if (!(spread.trace() > 0.0)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  // An axis has two signs: its largest component is positive.
  const auto signed_axis = [&](int column) {
    Eigen::Vector3d axis = axes.eigenvectors().col(column);
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    return Eigen::Vector3d(axis[largest] < 0.0 ? -axis : axis);
  };
  const Eigen::Vector3d u = signed_axis(2), v = signed_axis(1);
  FigurePanel out;
  out.title = "Path of the tip";
  out.x.label = "along its largest spread, mm";
  out.y.label = "across, mm";
  out.equal_scales = true;
  for (std::size_t k = 0; k < results.size(); ++k) {
    if (!results[k].path || results[k].path->size() == 0) continue;
    FigureCurve curve{results.size() > 1 ? results[k].name : "", {}, {}, line_colour(k)};
    for (const Eigen::Vector3d& p : results[k].path->p_world_tip_m) {
      curve.x.push_back(kMm * u.dot(p - mean_m[k]));
      curve.y.push_back(kMm * v.dot(p - mean_m[k]));
    }
    out.curves.push_back(std::move(curve));
  }
  return out;
}

std::optional<FigurePanel> compliance_panel(const std::vector<DrawnResult>& results) {
  FigurePanel out;
  out.title = "Compliance";
  out.x.label = "mean force, N";
  out.y.label = "force/acceleration over its mean";
  for (std::size_t k = 0; k < results.size(); ++k) {
    if (!results[k].compliance || results[k].compliance->force_N.empty()) continue;
    const ComplianceCurve& c = *results[k].compliance;
    out.curves.push_back({legend(results, results[k], "window"), c.force_N, c.ratio, line_colour(k), true});
    const auto [least, most] = std::minmax_element(c.force_N.begin(), c.force_N.end());
    if (!c.determined) out.title = results.size() > 1 ? "Compliance" : "Compliance: not determined";
    if (!c.determined || !std::isfinite(c.exponent) || !(*least > 0.0)) continue;
    // The power of the force that has the windows' mean ratio.
    double sum = 0.0, ratio = 0.0;
    for (std::size_t i = 0; i < c.force_N.size(); ++i) {
      sum += std::pow(c.force_N[i], c.exponent);
      ratio += c.ratio[i];
    }
    FigureCurve law{results.size() > 1 ? "" : fmt::format("force^{:.2f}", c.exponent), {}, {}, line_colour(k)};
    if (results.size() == 1) law.colour = line_colour(1);
    constexpr int kPoints = 60;
    for (int i = 0; i <= kPoints; ++i) {
      const double force_N = *least + (*most - *least) * i / kPoints;
      law.x.push_back(force_N);
      law.y.push_back(ratio / sum * std::pow(force_N, c.exponent));
    }
    out.curves.push_back(std::move(law));
  }
  if (out.curves.empty()) return std::nullopt;
  return out;
}

FigureMap map_panel(const NamedMap& map) {
  FigureMap out;
  out.title = map.title;
  out.columns = map.map.columns;
  out.rows = map.map.rows;
  out.x_spacing = kMm * map.map.x_spacing_m;
  out.y_spacing = kMm * map.map.y_spacing_m;
  out.value = scaled(map.map.height_m, kUm);
  out.x_label = "x, mm";
  out.y_label = "y, mm";
  out.value_label = "µm";
  return out;
}

}  // namespace asperity::studio
