#include "asperity/pipeline/make_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/geometry/connected_point.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/json/config_json.h"
#include "asperity/texture/evaluate_spline_grid.h"
#include "asperity/verdict/judge_area.h"
#include "asperity/verdict/verdict_codes.h"
#include "asperity/verdict/verdict_json.h"
#include "json.h"

namespace asperity {

namespace {

constexpr std::uint32_t kOutside = std::numeric_limits<std::uint32_t>::max();

// The places of a path in the plane; nan outside the patch.
std::vector<Eigen::Vector2d> path_in_plane(const MeshSurface& surface, const SurfacePatch& patch,
                                           const std::vector<std::uint32_t>& place, const FlatPatch& flat,
                                           const MeshPath& path) {
  std::vector<Eigen::Vector2d> out;
  for (std::size_t i = 0; i < path.size(); ++i) {
    out.push_back(Eigen::Vector2d::Constant(kNan));
    const std::uint32_t t = place[path.triangle[i]];
    if (t == kOutside) continue;
    const Eigen::Vector3d weight = weights_of(surface.mesh, path.triangle[i], path.p_mesh_m[i]);
    out.back().setZero();
    for (int c = 0; c < 3; ++c)
      out.back() += weight[c] * flat.uv_m[patch.mesh.triangles[t][static_cast<std::size_t>(c)]];
  }
  return out;
}

// Heights over the plane: the profile's, at the path's places by arc length. Steps of the path that are much longer
// than its others are gaps.
AreaStroke stroke_in_plane(const Profile& profile, const MeshPath& path, const std::vector<Eigen::Vector2d>& uv_m) {
  AreaStroke out;
  out.spacing_m = profile.spacing_m;
  std::vector<double> steps;
  for (std::size_t i = 1; i < path.size(); ++i) steps.push_back(path.s_m[i] - path.s_m[i - 1]);
  double longest_m = 0.0;
  if (!steps.empty()) {
    std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
    longest_m = 4.0 * steps[steps.size() / 2];
  }
  double noise2 = 0.0, count = 0.0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double s_m = profile.s_m[i];
    while (next < path.size() && path.s_m[next] < s_m) ++next;
    Eigen::Vector2d at = Eigen::Vector2d::Constant(kNan);
    if (next > 0 && next < path.size() && path.s_m[next] - path.s_m[next - 1] <= longest_m) {
      const double share = (s_m - path.s_m[next - 1]) / (path.s_m[next] - path.s_m[next - 1]);
      at = (1.0 - share) * uv_m[next - 1] + share * uv_m[next];
    }
    const bool known = at.allFinite() && std::isfinite(profile.height_m[i]);
    out.x_m.push_back(known ? at.x() : kNan);
    out.y_m.push_back(known ? at.y() : kNan);
    out.height_m.push_back(known ? profile.height_m[i] : kNan);
    if (known && i < profile.texture_sigma_m.size() && std::isfinite(profile.texture_sigma_m[i])) {
      noise2 += profile.texture_sigma_m[i] * profile.texture_sigma_m[i];
      count += 1.0;
    }
  }
  if (count > 0.0) out.noise_m = std::sqrt(noise2 / count);
  return out;
}

// The plane turned so that x is the direction that the strokes have in common, either way round, and mirrored so that y
// is to the right of x seen from outside (erratum 17).
Eigen::Matrix2d strokes_frame(const std::vector<std::vector<Eigen::Vector2d>>& strokes) {
  double cosine = 0.0, sine = 0.0;
  for (const auto& uv_m : strokes) {
    for (std::size_t i = 1; i < uv_m.size(); ++i) {
      const Eigen::Vector2d step = uv_m[i] - uv_m[i - 1];
      if (!step.allFinite() || step.norm() == 0.0) continue;
      const double angle = 2.0 * std::atan2(step.y(), step.x());
      cosine += step.norm() * std::cos(angle);
      sine += step.norm() * std::sin(angle);
    }
  }
  const double angle = 0.5 * std::atan2(sine, cosine);
  Eigen::Matrix2d out;
  out << std::cos(angle), std::sin(angle), std::sin(angle), -std::cos(angle);
  return out;
}

// True where the map has heights.
bool is_covered(const ArealTexture& texture, const Eigen::Vector2d& uv_m) {
  const SplineGrid& g = texture.surface;
  const auto column = static_cast<std::int64_t>(std::lround((uv_m.x() - g.origin_x_m) / g.spacing_x_m));
  const auto row = static_cast<std::int64_t>(std::lround((uv_m.y() - g.origin_y_m) / g.spacing_y_m));
  if (column < 2 || row < 2 || column + 2 >= static_cast<std::int64_t>(g.columns) ||
      row + 2 >= static_cast<std::int64_t>(g.rows))
    return false;
  return texture.supported[static_cast<std::size_t>(row) * g.columns + static_cast<std::size_t>(column)] != 0;
}

// Part of a triangle of the plane that has heights, by points a grid spacing apart.
double covered_part(const ArealTexture& texture, const std::array<Eigen::Vector2d, 3>& corner_m) {
  double longest_m = 0.0;
  for (std::size_t c = 0; c < 3; ++c) longest_m = std::max(longest_m, (corner_m[(c + 1) % 3] - corner_m[c]).norm());
  const int n = std::clamp(static_cast<int>(std::ceil(longest_m / texture.surface.spacing_x_m)), 2, 64);
  double inside = 0.0, covered = 0.0;
  for (int a = 0; a < n; ++a) {
    for (int b = 0; a + b < n; ++b) {
      const double u = (a + 1.0 / 3.0) / n, v = (b + 1.0 / 3.0) / n;
      const Eigen::Vector2d p = (1.0 - u - v) * corner_m[0] + u * corner_m[1] + v * corner_m[2];
      inside += 1.0;
      covered += is_covered(texture, p) ? 1.0 : 0.0;
    }
  }
  return covered / inside;
}

double area_of(const TriangleMesh& mesh, std::uint32_t t) {
  const Triangle& v = mesh.triangles[t];
  return 0.5 *
         (mesh.vertices_m[v[1]] - mesh.vertices_m[v[0]]).cross(mesh.vertices_m[v[2]] - mesh.vertices_m[v[0]]).norm();
}

// The texture's place on the mesh, its coordinates moved so that the map begins at 0.
void lay_on_mesh(const SurfacePatch& patch, AreaResult& out) {
  constexpr double kLeastCovered = 0.5;
  SplineGrid& surface = out.map.texture.surface;
  const Eigen::Vector2d corner_m(surface.origin_x_m + 2.0 * surface.spacing_x_m,
                                 surface.origin_y_m + 2.0 * surface.spacing_y_m);
  surface.origin_x_m = -2.0 * surface.spacing_x_m;
  surface.origin_y_m = -2.0 * surface.spacing_y_m;
  for (Eigen::Vector2d& uv_m : out.flat.uv_m) uv_m -= corner_m;
  double covered_m2 = 0.0;
  for (std::uint32_t t = 0; t < patch.mesh.triangles.size(); ++t) {
    std::array<Eigen::Vector2d, 3> corner;
    HapticTriangle haptic;
    haptic.texture = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      corner[c] = out.flat.uv_m[patch.mesh.triangles[t][c]];
      haptic.xy_mm[c] = 1e3 * corner[c];
    }
    const double part = covered_part(out.map.texture, corner);
    covered_m2 += part * area_of(patch.mesh, t);
    if (part < kLeastCovered) continue;
    out.triangle.push_back(patch.triangle[t]);
    out.coordinates.push_back(haptic);
  }
  out.covered = out.area_m2 > 0.0 ? covered_m2 / out.area_m2 : 0.0;
}

Texture texture_of(const AreaResult& result, double drift_mm) {
  Texture out;
  out.name = "area";
  out.height_offset_m = -lowest_height_m(result.map.texture.surface);
  out.height_sigma_m = result.map.sigma_rms_m;
  out.band_cycles_per_mm = {1.0 / drift_mm, 1e-3 / (3.0 * result.map.texture.surface.spacing_x_m)};
  out.roughness["Sq_m"] = result.map.rms_m;
  out.source.version = kVersion;
  out.source.snr = std::pow(result.map.rms_m / std::max(result.map.disagreement_m, 1e-12), 2);
  out.model = result.map.texture;
  return out;
}

}  // namespace

AreaResult make_area(const TriangleMesh& mesh, const std::vector<AreaScan>& scans, bool registered,
                     const AreaConfig& config, const Observer& observer) {
  AreaResult out;
  out.config = config;
  observer.update("patch", 0.0);
  const MeshSurface surface(mesh);
  std::vector<MeshPath> paths;
  for (const AreaScan& scan : scans) paths.push_back(scan.path);
  const SurfacePatch patch = find_surface_patch(surface, paths, config.patch);
  out.patch_triangles = patch.triangle.size();
  out.filled = patch.filled;
  for (std::uint32_t t = 0; t < patch.mesh.triangles.size(); ++t) out.area_m2 += area_of(patch.mesh, t);
  for (const std::size_t i : patch.paths_apart) out.apart.push_back(scans[i].name);
  if (!out.apart.empty()) {
    out.problems.push_back({"not_on_patch",
                            std::to_string(out.apart.size()) + " scans are not on the patch of the others",
                            out.apart.size()});
  }

  observer.update("parametrisation", 0.0);
  out.flat = flatten_patch(patch, config.parametrisation);
  std::vector<std::uint32_t> place(mesh.triangles.size(), kOutside);
  for (std::uint32_t t = 0; t < patch.triangle.size(); ++t) place[patch.triangle[t]] = t;
  std::vector<std::vector<Eigen::Vector2d>> in_plane;
  for (const MeshPath& path : paths) in_plane.push_back(path_in_plane(surface, patch, place, out.flat, path));
  const Eigen::Matrix2d frame = strokes_frame(in_plane);
  for (Eigen::Vector2d& uv_m : out.flat.uv_m) uv_m = frame * uv_m;

  std::vector<AreaStroke> strokes;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (Eigen::Vector2d& uv_m : in_plane[i]) uv_m = frame * uv_m;
    strokes.push_back(stroke_in_plane(scans[i].profile, paths[i], in_plane[i]));
  }
  out.map = map_strokes(strokes, config.map, observer);
  out.problems.insert(out.problems.end(), out.map.problems.begin(), out.map.problems.end());
  const bool mapped = !out.map.texture.surface.coefficient_m.empty();
  if (mapped) lay_on_mesh(patch, out);

  AreaEvidence evidence;
  evidence.registered = registered;
  evidence.strokes = scans.size();
  evidence.ties = out.map.ties;
  evidence.agreement = out.map.agreement;
  evidence.agreement_sigma = out.map.agreement_sigma;
  evidence.rms_m = out.map.rms_m;
  double noise2 = 0.0;
  for (const AreaStroke& stroke : strokes)
    noise2 += stroke.noise_m * stroke.noise_m / static_cast<double>(strokes.size());
  evidence.noise_m = noise2 > 0.0 ? std::sqrt(noise2) : AreaEvidence::kUnknown;
  if (mapped) evidence.covered = out.covered;
  evidence.correlation_mm = out.map.correlation_mm;
  evidence.held_out_ratio = out.map.held_out.error_over_sigma;
  evidence.stretch_min = out.flat.stretch_min;
  evidence.stretch_max = out.flat.stretch_max;
  out.verdicts = judge_area(evidence);
  out.trustworthy = is_trustworthy(out.verdicts);
  out.verdict = verdict_sentence(out.verdicts);
  if (mapped && out.trustworthy) {
    out.texture = texture_of(out, config.map.drift_mm);
  } else {
    out.triangle.clear();
    out.coordinates.clear();
  }
  return out;
}

std::string format_area(const AreaResult& result, const std::vector<AreaScan>& scans, const std::string& name) {
  const StrokeMap& map = result.map;
  Json out;
  out["format"] = "asperity-area";
  out["version"] = 1;
  out["texture"] = name.empty() ? Json(nullptr) : Json(name);
  out["trustworthy"] = result.trustworthy;
  out["verdict"] = result.verdict;
  out["verdicts"] = verdicts_json(result.verdicts);
  out["patch"] = {{"triangles", result.patch_triangles},
                  {"filled", result.filled},
                  {"area_mm2", 1e6 * result.area_m2},
                  {"covered", number_or_null(result.covered)},
                  {"textured_triangles", result.triangle.size()},
                  {"apart", result.apart}};
  out["parametrisation"] = {{"energy", result.flat.energy},           {"stretch_min", result.flat.stretch_min},
                            {"stretch_max", result.flat.stretch_max}, {"stretch_rms", result.flat.stretch_rms},
                            {"flipped", result.flat.flipped},         {"without_area", result.flat.without_area},
                            {"iterations", result.flat.iterations},   {"converged", result.flat.converged}};
  const SplineGrid& grid = map.texture.surface;
  out["map"] = {{"columns", grid.columns},
                {"rows", grid.rows},
                {"spacing_mm", 1e3 * grid.spacing_x_m},
                {"rms_m", number_or_null(map.rms_m)},
                {"sigma_rms_m", number_or_null(map.sigma_rms_m)},
                {"correlation_mm", number_or_null(map.correlation_mm)},
                {"agreement", number_or_null(map.agreement)},
                {"agreement_sigma", number_or_null(map.agreement_sigma)},
                {"ties", map.ties},
                {"disagreement_m", number_or_null(map.disagreement_m)},
                {"spectrum",
                 {{"A_m2_per_mm2", number_or_null(map.spectrum.A)},
                  {"kappa_per_mm", number_or_null(map.spectrum.kappa_per_mm)},
                  {"t", number_or_null(map.spectrum.t)}}}};
  out["held_out"] = {{"strokes", map.held_out.strokes},
                     {"samples", map.held_out.samples},
                     {"error_rms_m", number_or_null(map.held_out.error_rms_m)},
                     {"error_over_sigma", number_or_null(map.held_out.error_over_sigma)},
                     {"explained", number_or_null(map.held_out.explained)}};
  out["scans"] = Json::array();
  for (std::size_t i = 0; i < scans.size(); ++i) {
    Json one{{"name", scans[i].name}};
    if (i < map.drift_rms_m.size()) {
      one["drift_rms_m"] = number_or_null(map.drift_rms_m[i]);
      one["shift_m"] = {number_or_null(map.shift_x_m[i]), number_or_null(map.shift_y_m[i])};
    }
    out["scans"].push_back(std::move(one));
  }
  out["problems"] = problems_json(result.problems);
  AreaConfig config = result.config;
  out["config"] = config_json(list_fields("", config));
  out["asperity"] = kVersion;
  return out.dump_repaired(2) + "\n";
}

}  // namespace asperity
