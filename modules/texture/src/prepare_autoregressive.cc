#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/autoregressive.h"
#include "asperity/texture/autoregressive_filter.h"
#include "asperity/texture/series_state.h"
#include "asperity/texture/triangulate_points.h"

namespace asperity {
namespace {

constexpr double kMinGap_rad = 1e-7;

[[noreturn]] void refuse(const std::string& name, const std::string& what, double value) {
  throw Error(name + ": " + what + " is " + number_text(value));
}

void check_number(const std::string& name, const std::string& what, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    throw Error(name + ": " + what + " " + number_text(value) + " is not within " + number_text(low) + " and " +
                number_text(high));
  }
}

void check_lsf(const std::string& name, const std::string& what, const std::vector<double>& lsf_rad) {
  double last = 0.0;
  for (std::size_t i = 0; i <= lsf_rad.size(); ++i) {
    const double next = i < lsf_rad.size() ? lsf_rad[i] : std::numbers::pi;
    if (!(next - last >= kMinGap_rad) || !std::isfinite(next)) {
      if (i == lsf_rad.size())
        refuse(name, "the last line spectral frequency of " + what + ", which must be below π,", last);
      refuse(
          name,
          "line spectral frequency " + std::to_string(i + 1) + " of " + what + ", which must be above the one before,",
          next);
    }
    last = next;
  }
}

void derive_powers(AutoregressiveModel& model) {
  model.pole_variance_m2_per_s4 = model.sigma_mps2 = -1.0;
  std::vector<double> a(model.ar_lsf_rad.size());
  std::vector<double> k(a.size());
  lsf_to_ar(model.ar_lsf_rad, a);
  if (!ar_to_reflection(a, k)) return;
  std::vector<double> b(model.ma_lsf_rad.size());
  lsf_to_ar(model.ma_lsf_rad, b);
  b.insert(b.begin(), 1.0);
  const auto r = autocovariance(k, model.variance, static_cast<int>(b.size()));
  double variance = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) variance += b[i] * b[j] * r[i > j ? i - j : j - i];
  }
  model.pole_variance_m2_per_s4 = r[0];
  model.sigma_mps2 = std::abs(model.gain) * std::sqrt(std::max(variance, 0.0));
}

void check_model(const std::string& name, const AutoregressiveModel& model, const AutoregressiveModel& first,
                 std::size_t number) {
  const std::string what = "model " + std::to_string(number);
  check_number(name, what + ": the speed", model.speed_mps, 0.0, 1e3);
  check_number(name, what + ": the force", model.force_N, 0.0, 1e6);
  check_number(name, what + ": the variance", model.variance, 0.0, 1e12);
  check_number(name, what + ": the gain", model.gain, -1e6, 1e6);
  const auto check_order = [&](const char* part, std::size_t order, std::size_t wanted, std::size_t least) {
    if (order < least || order > static_cast<std::size_t>(kMaxSeriesOrder) || order != wanted) {
      throw Error(name + ": " + what + " has " + std::to_string(order) + " " + part +
                  " frequencies where the first has " + std::to_string(wanted) + "; " + std::to_string(least) + " to " +
                  std::to_string(kMaxSeriesOrder) + " are possible");
    }
  };
  check_order("AR", model.ar_lsf_rad.size(), first.ar_lsf_rad.size(), 1);
  check_order("MA", model.ma_lsf_rad.size(), first.ma_lsf_rad.size(), 0);
  check_lsf(name, what, model.ar_lsf_rad);
  if (!model.ma_lsf_rad.empty()) check_lsf(name, what + " (MA)", model.ma_lsf_rad);
}

// Counter-clockwise in the plane; triangles without area are of no use and go.
void wind_points(AutoregressiveTexture& t) {
  const auto area = [&](const std::array<int, 3>& tri) {
    const auto& a = t.models[static_cast<std::size_t>(tri[0])];
    const auto& b = t.models[static_cast<std::size_t>(tri[1])];
    const auto& c = t.models[static_cast<std::size_t>(tri[2])];
    return (b.speed_mps - a.speed_mps) * (c.force_N - a.force_N) -
           (b.force_N - a.force_N) * (c.speed_mps - a.speed_mps);
  };
  std::erase_if(t.triangles, [&](const auto& tri) { return area(tri) == 0.0; });
  for (auto& tri : t.triangles) {
    if (area(tri) < 0.0) std::swap(tri[1], tri[2]);
  }
}

}  // namespace

void prepare_autoregressive(AutoregressiveTexture& texture, const std::string& name) {
  if (texture.models.empty() || texture.models.size() > static_cast<std::size_t>(kMaxSeriesModels)) {
    throw Error(name + ": " + std::to_string(texture.models.size()) + " models; 1 to " +
                std::to_string(kMaxSeriesModels) + " are possible");
  }
  check_number(name, "the rate", texture.rate_Hz, 1.0, 1e6);
  check_number(name, "the mass", texture.mass_kg, 0.0, 1e3);
  check_number(name, "the tangential ratio", texture.tangential_ratio, -1e3, 1e3);
  check_number(name, "the height offset", texture.offset_sigmas, 0.0, 10.0);
  check_number(name, "the speed of fading", texture.fade_speed_mps, 0.0, 1e3);
  check_number(name, "the force of fading", texture.fade_force_N, 0.0, 1e6);
  check_number(name, "the largest speed", texture.max_speed_mps, 0.0, 1e3);
  check_number(name, "the largest force", texture.max_force_N, 0.0, 1e6);
  std::size_t number = 0;
  for (const auto& model : texture.models) check_model(name, model, texture.models.front(), ++number);
  number = 0;
  for (auto& model : texture.models) {
    ++number;
    derive_powers(model);
    if (model.sigma_mps2 < 0.0)
      throw Error(name + ": model " + std::to_string(number) +
                  " is at the limit of stability, as that of a tone without noise");
    if (!(model.sigma_mps2 >= 0.0 && model.sigma_mps2 <= 1e9 && model.pole_variance_m2_per_s4 <= 1e18))
      refuse(name, "the output's standard deviation of model " + std::to_string(number), model.sigma_mps2);
    if (texture.max_speed_mps < model.speed_mps) texture.max_speed_mps = model.speed_mps;
    if (texture.max_force_N < model.force_N) texture.max_force_N = model.force_N;
  }
  // A set of models at rest or without force still needs a unit of length in the plane.
  if (!(texture.max_speed_mps > 0.0)) texture.max_speed_mps = 1.0;
  if (!(texture.max_force_N > 0.0)) texture.max_force_N = 1.0;

  if (texture.triangles.size() > static_cast<std::size_t>(kMaxSeriesTriangles))
    throw Error(name + ": " + std::to_string(texture.triangles.size()) + " triangles, more than " +
                std::to_string(kMaxSeriesTriangles));
  for (const auto& t : texture.triangles) {
    for (const int v : t) {
      if (v < 0 || v >= static_cast<int>(texture.models.size()))
        throw Error(name + ": a triangle of model " + std::to_string(v) + "; there are " +
                    std::to_string(texture.models.size()) + ", counted from 0");
    }
  }
  wind_points(texture);
  std::vector<PlanePoint> points;
  for (const auto& model : texture.models)
    points.push_back({model.speed_mps / texture.max_speed_mps, model.force_N / texture.max_force_N});
  if (texture.triangles.empty()) texture.triangles = triangulate_points(points);
  texture.edges = border_edges(points, texture.triangles);
}

}  // namespace asperity
