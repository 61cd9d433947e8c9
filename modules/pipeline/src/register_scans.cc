#include "asperity/pipeline/register_scans.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/pipeline/locate_scans.h"
#include "asperity/pipeline/process_motion.h"
#include "asperity/pipeline/scan_evidence.h"
#include "asperity/pipeline/scan_points.h"
#include "asperity/profile/base_path_on_mesh.h"
#include "asperity/profile/make_profile.h"
#include "asperity/verdict/verdict_codes.h"
#include "merge_scans.h"

namespace asperity {

namespace {

void append_problems(Problems& to, const Problems& from) { to.insert(to.end(), from.begin(), from.end()); }

void add_verdict(ScansOnMesh& result, std::string_view code, std::string message) {
  result.verdicts.push_back(make_verdict(code, std::move(message)));
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

// Height over the mesh of a path alone: of what a recording gives, only what needs no probe.
void measure_path(const RegisterConfig& config, const FindBase& find_base, RegisteredScan& scan) {
  ProcessResult& result = scan.process;
  try {
    result.base = find_base(result.trajectory.motion);
    append_problems(result.problems, result.base.problems);
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
  texture.height_offset_m = scan.path_texture->series.height_offset_m;
  append_problems(result.problems, scan.path_texture->series.problems);
  const double nyquist = 0.5 / (result.profile.spacing_m * 1e3);
  texture.band_cycles_per_mm = {config.process.profile.cutoff_cycles_per_mm,
                                std::min(config.texture.coefficients_per_mm, nyquist)};
  texture.source.version = kVersion;
  scan.texture = std::move(texture);
}

// The motion with the tip where the registration has found it in the marker.
void shift_tip(const Eigen::Vector3d& shift_m, const Eigen::Vector3d& sigma_m, TipMotion& motion) {
  const Eigen::Vector3d gain_m2 = sigma_m.cwiseAbs2() - motion.sigma_tip_in_marker_m.cwiseAbs2();
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Eigen::Matrix3d R = motion.q_world_marker[i].toRotationMatrix();
    motion.p_world_tip_m[i] += R * shift_m;
    if (motion.cov_world_tip_m2.empty()) continue;
    motion.cov_world_tip_m2.set(i, motion.cov_world_tip_m2[i] + R * gain_m2.asDiagonal() * R.transpose());
  }
  motion.sigma_tip_in_marker_m = sigma_m;
}

// The motion without its slow error, which is known at some of its samples.
TipMotion correct_motion(TipMotion motion, const std::vector<double>& sample,
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

void measure_scan(const Scan& scan, const MeshSurface& surface, const Pose& T_mesh_world, double bulge_share,
                  const RegisterConfig& config, const PathPoints& points,
                  const std::vector<Eigen::Vector3d>& slow_error_world_m, RegisteredScan& registered,
                  const Observer& observer) {
  TipMotion& measured = registered.process.trajectory.motion;
  if (registered.tip_sigma_m) shift_tip(registered.tip_shift_m, *registered.tip_sigma_m, measured);
  measured = correct_motion(std::move(measured), points.sample, slow_error_world_m);
  // Base points and normals of the registered mesh (seed §4.3).
  const FindBase find_base = [&](const TipMotion& motion) {
    BasePathResult base =
        base_path_on_mesh(motion, tip_in_marker_m(scan), surface, T_mesh_world, config.process.base, bulge_share);
    const ProcessMethod& method = ProcessMethods::get(config.process.method);
    if (scan.recording && method.measure_arc_length) method.measure_arc_length(base.path);
    return base;
  };
  if (scan.recording) {
    // Lines that are passed again, by this scan or by others, are merged when all are measured.
    ProcessConfig apart = config.process;
    apart.profile.merge_passes = false;
    measure_along(*scan.recording, apart, find_base, registered.process, observer);
    registered.process.config = config.process;
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
                           const RegisterConfig& config, const RegistrationObserver& observer) {
  ScansOnMesh out;
  out.config = config;

  // Where the tips were.
  ScanPoints begun = find_scan_points(scans, config, observer);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    RegisteredScan& scan = out.scans.emplace_back();
    scan.name = scans[i].name;
    scan.is_recording = scans[i].recording.has_value();
    scan.process = std::move(begun.motions[i]);
    scan.fingerprint = std::move(begun.fingerprints[i]);
  }

  // Where they lie on the mesh (seed §5.4).
  observer.update("mesh", 0.0);
  const MeshSurface surface(mesh);
  LocatedScans located = locate_scans(begun, surface, guess, config, observer);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    out.scans[i].rms_m = located.rms_m[i];
    if (located.tip_sigma_m.empty() || located.tip_sigma_m[i].isZero(0.0)) continue;
    out.scans[i].tip_shift_m = located.tip_shift_m[i];
    out.scans[i].tip_sigma_m = located.tip_sigma_m[i];
  }
  out.bulge_share = located.bulge_share;
  out.bulge_sigma = located.bulge_sigma;
  out.crossings = located.crossings;
  out.matched_shifts = located.matched_shifts;
  out.placements = std::move(located.placements);
  for (std::size_t k = 0; k < out.placements.size(); ++k) {
    Placement& placement = out.placements[k];
    append_problems(out.problems, placement.registration.problems);
    placement.verdicts = judge_pose(placement.registration, guess.has_value());
    for (const std::size_t i : placement.scans) out.scans[i].placement = k;
    if (out.placements.size() == 1) {
      out.verdicts = placement.verdicts;
    } else {
      append_verdicts(out.verdicts, placement.verdicts, fmt::format("placement {}", k + 1));
    }
  }

  // What they met there.
  std::vector<MeshPath> mesh_paths;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    RegisteredScan& scan = out.scans[i];
    named(scan.name, [&] {
      measure_scan(scans[i], surface, out.registration_of(scan).T_mesh_world, out.bulge_share, config, begun.points[i],
                   located.slow_error_world_m[i], scan, observer);
      return 0;
    });
    if (scan.path.size() < 2) {
      add_verdict(out, "no_path_on_mesh", printable(scan.name, 200) + ": the path is not on the mesh");
      scan.path = {};
    }
    mesh_paths.push_back(scan.path);
  }
  if (config.process.profile.merge_passes) {
    for (const std::size_t i : merge_scans(scans, config, out)) {
      if (!scans[i].texture) make_own_texture(config, out.scans[i]);
    }
  }
  for (const RegisteredScan& scan : out.scans)
    append_verdicts(out.verdicts, scan.process.verdicts, printable(scan.name, 200));

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
    add_verdict(out, "no_haptic_coordinates", std::string("haptic coordinates could not be computed: ") + error.what());
  }
  append_problems(out.problems, out.coordinates.problems);
  observer.update("coordinates", 1.0);
  sort_verdicts(out.verdicts);
  out.trustworthy = is_trustworthy(out.verdicts);
  out.verdict = verdict_sentence(out.verdicts);
  return out;
}

}  // namespace asperity
