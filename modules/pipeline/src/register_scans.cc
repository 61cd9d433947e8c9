#include "asperity/pipeline/register_scans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/pipeline/config_json.h"
#include "asperity/pipeline/process_motion.h"
#include "asperity/profile/base_path_on_mesh.h"
#include "asperity/profile/find_contact.h"
#include "asperity/profile/make_profile.h"
#include "asperity/registration/find_registration.h"
#include "asperity/registration/refine_registration.h"
#include "asperity/registration/register_path.h"

namespace asperity {

namespace {

void append(Problems& to, const Problems& from) { to.insert(to.end(), from.begin(), from.end()); }

void distrust(ScansOnMesh& result, const std::string& why) {
  result.trustworthy = false;
  result.verdict += (result.verdict.empty() ? "" : "; ") + why;
}

// Runs a step on a scan; what it throws names the scan.
template <class Step>
auto named(const std::string& scan, Step step) {
  try {
    return step();
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    throw Error(printable(scan, 200) + ": " + error.what());
  }
}

struct PoseStep {
  Eigen::Vector3d turn, shift_m;
};

// Turns and shifts within balls of the given radii, on an additive sequence (Roberts 2018) of six numbers.
std::vector<PoseStep> spread_steps(int count, double shift_m, double turn_rad) {
  constexpr double kRoot = 1.1347241384015194;  // x⁷ = x + 1
  std::vector<PoseStep> out;
  for (int i = 1; out.size() < static_cast<std::size_t>(count) && i < 100 * count; ++i) {
    std::array<double, 6> u{};
    double power = 1.0;
    for (double& value : u) {
      power /= kRoot;
      value = 2.0 * std::fmod(0.5 + power * i, 1.0) - 1.0;
    }
    const Eigen::Vector3d a(u[0], u[1], u[2]), b(u[3], u[4], u[5]);
    if (a.norm() <= 1.0 && b.norm() <= 1.0) out.push_back({turn_rad * a, shift_m * b});
  }
  return out;
}

// The tip's offset; zero for a path alone, whose probe is unknown.
Eigen::Vector3d tip_of(const Scan& scan) {
  return scan.recording ? scan.recording->calibration.tip_in_marker_m : Eigen::Vector3d::Zero();
}

// A path without times is given some: evenly, at a usual speed of the hand. Only its sequence counts.
void spread_times(TipMotion& motion) {
  constexpr double kUsual_mps = 0.025;
  constexpr std::size_t kChords = 200;  // few enough for noise not to lengthen them much
  const std::size_t n = motion.size(), step = std::max<std::size_t>(1, n / kChords);
  double length_m = 0.0;
  for (std::size_t i = step; i < n; i += step) {
    length_m += (motion.p_world_tip_m[i] - motion.p_world_tip_m[i - step]).norm();
  }
  constexpr double kLongest_ns = 1e18;  // 30 years: what a length in other units than metres makes of it
  const double step_ns = std::max(1.0, std::min(length_m / kUsual_mps * 1e9, kLongest_ns) / static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) motion.t_ns[i] = static_cast<std::int64_t>(static_cast<double>(i) * step_ns);
}

RegisteredScan begin_scan(const Scan& scan, const RegisterConfig& config, const Observer& observer) {
  RegisteredScan out;
  out.name = scan.name;
  out.is_recording = scan.recording.has_value();
  if (scan.recording) {
    out.process = estimate_motion(*scan.recording, config.process, observer);
  } else {
    out.process.trajectory.motion = scan.path.motion;
    out.process.problems = scan.path.problems;
    if (!scan.path.timed) spread_times(out.process.trajectory.motion);
  }
  return out;
}

PathPoints points_of(const Scan& scan, const RegisteredScan& registered, const RegisterConfig& config) {
  const TipMotion& motion = registered.process.trajectory.motion;
  // Points without times stand for themselves: nothing rests in them.
  if (!scan.recording && !scan.path.timed) {
    PathPoints out;
    out.path.p_world_m = motion.p_world_tip_m;
    for (std::size_t i = 0; i < motion.size(); ++i) out.sample.push_back(static_cast<double>(i));
    return out;
  }
  return measured_path(motion, find_contact(motion, config.process.base.contact), tip_of(scan), config.points);
}

// Height over the mesh of a path alone: of what a recording gives, only what needs no probe.
void measure_path(const RegisterConfig& config, const FindBase& find_base, RegisteredScan& scan) {
  ProcessResult& result = scan.process;
  try {
    result.base = find_base(result.trajectory.motion);
    append(result.problems, result.base.problems);
    result.profile =
        make_profile(result.trajectory.motion, result.base.path, result.base.contact, config.process.profile);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    result.problems.push_back({"no_profile", std::string("no profile: ") + error.what(), 1});
  }
}

// The scan's own texture along its whole path, with what was measured of it.
void make_own_texture(const RegisterConfig& config, RegisteredScan& scan) {
  ProcessResult& result = scan.process;
  try {
    scan.path_texture = fit_path_texture(result.profile, config.texture);
  } catch (const Error& error) {
    result.problems.push_back({"no_path_texture", std::string("no texture along the path: ") + error.what(), 1});
    return;
  }
  Texture texture = result.texture.value_or(Texture{});
  if (texture.name.empty()) texture.name = scan.name;
  texture.model = scan.path_texture->series.fit.texture;
  texture.lift_m = scan.path_texture->series.lift_m;
  append(result.problems, scan.path_texture->series.problems);
  const double nyquist = 0.5 / (result.profile.spacing_m * 1e3);
  texture.band_cycles_per_mm = {config.process.profile.cutoff_cycles_per_mm,
                                std::min(config.texture.coefficients_per_mm, nyquist)};
  texture.source.version = kVersion;
  scan.texture = std::move(texture);
}

// Where fits end that begin at other guesses, evenly spread about the given one.
std::vector<Pose> other_fits(const std::vector<MeasuredPath>& paths, const RegistrationSurface& surface,
                             const std::optional<Pose>& guess, RegistrationConfig config, const RefineConfig& refine) {
  std::vector<Pose> out;
  if (!guess || !refine.enabled) return out;
  config.starts.when = OtherStarts::kNever;
  config.max_points = config.coarse_points;
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (const MeasuredPath& path : paths) {
    for (const Eigen::Vector3d& p_m : path.p_world_m) middle_m += p_m;
    count += path.p_world_m.size();
  }
  middle_m = *guess * Eigen::Vector3d(middle_m / static_cast<double>(std::max<std::size_t>(1, count)));
  for (const PoseStep& step :
       spread_steps(refine.other_starts, refine.other_shift_m, refine.other_turn_deg * std::numbers::pi / 180.0)) {
    const Eigen::Quaterniond turn = exp_rotation(step.turn);
    const Pose about{turn * guess->rotation, turn * (guess->translation_m - middle_m) + middle_m + step.shift_m};
    out.push_back(register_path(paths, surface, about, config).T_mesh_world);
  }
  return out;
}

// A motion known less well than a guess by hand.
bool is_arbitrary(const RegistrationResult& registration) {
  constexpr double kGuess_m = 5e-3;
  return std::any_of(registration.undetermined.begin(), registration.undetermined.end(),
                     [](const UndeterminedMotion& motion) { return !(motion.sigma_m < kGuess_m); });
}

bool in_sequence(const std::vector<Scan>& scans) {
  return std::all_of(scans.begin(), scans.end(),
                     [](const Scan& scan) { return scan.recording.has_value() || scan.path.timed; });
}

// The motion without its slow error, which is known at some of its samples.
TipMotion corrected(TipMotion motion, const std::vector<double>& sample,
                    const std::vector<Eigen::Vector3d>& error_world_m) {
  if (error_world_m.empty()) return motion;
  std::size_t next = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const auto at = static_cast<double>(i);
    while (next < sample.size() && sample[next] < at) ++next;
    const std::size_t before = next == 0 ? 0 : next - 1, after = std::min(next, sample.size() - 1);
    const double width = sample[after] - sample[before];
    const double share = width > 0.0 ? (at - sample[before]) / width : 0.0;
    motion.p_world_tip_m[i] -= lerp(error_world_m[before], error_world_m[after], share);
  }
  return motion;
}

void measure_scan(const Scan& scan, const MeshSurface& surface, const Pose& T_mesh_world, const RegisterConfig& config,
                  const PathPoints& points, const std::vector<Eigen::Vector3d>& slow_error_world_m,
                  RegisteredScan& registered, const Observer& observer) {
  const Eigen::Vector3d tip_in_marker_m = tip_of(scan);
  // Base points and normals of the registered mesh (seed §4.3).
  const FindBase find_base = [&](const TipMotion& motion) {
    return base_path_on_mesh(corrected(motion, points.sample, slow_error_world_m), tip_in_marker_m, surface,
                             T_mesh_world, config.process.base);
  };
  if (scan.recording) {
    measure_along(*scan.recording, config.process, find_base, registered.process, observer);
  } else {
    measure_path(config, find_base, registered);
  }
  registered.texture = scan.texture;
  // A path of points alone knows their places, hardly the relief.
  if (!scan.texture && (scan.recording || scan.path.timed)) make_own_texture(config, registered);

  registered.path = scan_on_mesh(registered.process.base, surface, T_mesh_world, config.path);
}

}  // namespace

ScansOnMesh register_scans(const std::vector<Scan>& scans, const TriangleMesh& mesh, const std::optional<Pose>& guess,
                           const RegisterConfig& config, const Observer& observer) {
  if (scans.empty()) throw Error("registration: no scan");
  ScansOnMesh out;
  RegisterConfig resolved = config;
  out.config_json = config_json(list_fields("", resolved));

  // Where the tips were.
  std::vector<PathPoints> points;
  std::vector<MeasuredPath> paths;
  for (const Scan& scan : scans) {
    out.scans.push_back(named(scan.name, [&] { return begin_scan(scan, config, observer); }));
    points.push_back(points_of(scan, out.scans.back(), config));
    paths.push_back(points.back().path);
  }

  // Where they lie on the mesh (seed §5.4).
  observer.update("mesh", 0.0);
  const MeshSurface surface(mesh);
  const RegistrationSurface ready = prepare_surface(surface.mesh, surface.bvh);
  observer.update("registration", 0.0);
  std::vector<MeasuredPath> smooth;
  smooth.reserve(paths.size());
  const bool sequence = in_sequence(scans);
  for (const MeasuredPath& path : paths) {
    smooth.push_back(sequence ? smooth_path(path, config.points.smoothing_m) : path);
  }
  SearchConfig search = config.search;
  if (sequence && search.registration.error_length_m == 0.0) {
    search.registration.error_length_m = config.refinement.slow_length_m;
  }
  out.registration =
      guess ? register_path(smooth, ready, *guess, search.registration) : find_registration(smooth, ready, search);
  // Scans have errors that last along the path; points without a sequence have none that is known.
  std::vector<std::vector<Eigen::Vector3d>> slow_error_world_m(scans.size());
  if (sequence) {
    const std::vector<Pose> others = other_fits(smooth, ready, guess, search.registration, config.refinement);
    RefinedRegistration refined = refine_registration(paths, surface, out.registration, others, config.refinement);
    out.registration = std::move(refined.registration);
    slow_error_world_m = std::move(refined.slow_error_world_m);
  }
  append(out.problems, out.registration.problems);
  if (!out.registration.trustworthy) distrust(out, out.registration.verdict);
  // Where the scans say nothing the guess counts; without one the place is arbitrary.
  if (!guess && is_arbitrary(out.registration)) {
    distrust(out, "without a guess, where the scans lie along undetermined motions is arbitrary");
  }

  // What they met there.
  std::vector<MeshPath> mesh_paths;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    RegisteredScan& scan = out.scans[i];
    named(scan.name, [&] {
      measure_scan(scans[i], surface, out.registration.T_mesh_world, config, points[i], slow_error_world_m[i], scan,
                   observer);
      return 0;
    });
    if (!scan.process.trustworthy) distrust(out, printable(scan.name, 200) + ": " + scan.process.verdict);
    if (scan.path.size() < 2) {
      distrust(out, printable(scan.name, 200) + ": no path on the mesh");
      scan.path = {};
    }
    mesh_paths.push_back(scan.path);
  }

  // Where a hand will find it (seed §5.4, B.2).
  observer.update("coordinates", 0.0);
  try {
    out.coordinates = assign_haptic_coordinates(surface.mesh, surface.adjacency, mesh_paths, config.coordinates);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    // A path from one part of the mesh to another, which nothing connects: the pose and the profiles still stand.
    out.coordinates = {};
    out.coordinates.triangles.resize(surface.mesh.triangles.size());
    out.coordinates.warps.resize(mesh_paths.size());
    distrust(out, std::string("no haptic coordinates: ") + error.what());
  }
  append(out.problems, out.coordinates.problems);
  observer.update("coordinates", 1.0);
  return out;
}

}  // namespace asperity
