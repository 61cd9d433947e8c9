#include "asperity/profile/length_on_surface.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr double kStep_m = 1e-3;
constexpr double kShortest = 0.5;  // of a step on the surface, of that of the tip

struct Knot {
  double s_m = 0.0, on_surface_m = 0.0;
};

std::vector<Knot> find_knots(const BasePath& path, std::span<const char> contact,
                             std::span<const double> indentation_m) {
  std::vector<Knot> out;
  std::size_t from = 0;
  double sum_m = 0.0, count = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (contact[i] == 0) continue;
    if (out.empty()) {
      from = i;
      out.push_back({path.s_m[i], path.s_m[i]});
    }
    if (std::isfinite(indentation_m[i])) {
      sum_m += indentation_m[i];
      count += 1.0;
    }
    const double step_m = path.s_m[i] - path.s_m[from];
    if (!(step_m >= kStep_m)) continue;
    const Eigen::Vector3d along_m = path.p_world_m[i] - path.p_world_m[from];
    const double turned = along_m.norm() > 0.0 ? along_m.normalized().dot(path.n_world[i] - path.n_world[from]) : 0.0;
    const double surface_m = std::max(step_m + (count > 0.0 ? sum_m / count : 0.0) * turned, kShortest * step_m);
    out.push_back({path.s_m[i], out.back().on_surface_m + surface_m});
    from = i;
    sum_m = count = 0.0;
  }
  return out;
}

}  // namespace

std::vector<double> length_on_surface(const BasePath& path, std::span<const char> contact,
                                      std::span<const double> indentation_m) {
  const std::size_t n = path.size();
  if (path.n_world.size() != n || path.s_m.size() != n || contact.size() != n || indentation_m.size() != n) {
    throw Error("length on the surface: path, contact and indentation differ in size");
  }
  const std::vector<Knot> knots = find_knots(path, contact, indentation_m);
  std::vector<double> out(path.s_m);
  if (knots.size() < 2) return out;
  for (double& s_m : out) {
    const auto above =
        std::upper_bound(knots.begin(), knots.end(), s_m, [](double s, const Knot& knot) { return s < knot.s_m; });
    // Beyond the ends, less than a step, with the slope of 1.
    const Knot& below = above == knots.begin() ? knots.front() : *(above - 1);
    if (above == knots.begin() || above == knots.end()) {
      s_m += below.on_surface_m - below.s_m;
      continue;
    }
    const double share = (s_m - below.s_m) / (above->s_m - below.s_m);
    s_m = below.on_surface_m + share * (above->on_surface_m - below.on_surface_m);
  }
  return out;
}

}  // namespace asperity
