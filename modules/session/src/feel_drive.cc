#include "asperity/session/feel_drive.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/read_replay_csv.h"
#include "asperity/pipeline/earlier_scene.h"
#include "asperity/recording/read_recording.h"
#include "asperity/session/register_input.h"

namespace asperity {

namespace {

namespace fs = std::filesystem;

// Of a scene with several scans, the pose of this recording's: by its checksum. nullopt: the scene's own pose serves.
std::optional<Pose> pose_in_scene(const Scene& scene, const std::string& recording) {
  const std::vector<const SceneTexture*> scans = scans_of(scene);
  if (scans.size() < 2) return std::nullopt;
  const std::string checksum = recording_checksum(recording);
  for (const SceneTexture* scan : scans) {
    if (scan->origin->checksum == checksum) return scan->origin->T_mesh_world;
  }
  return std::nullopt;
}

FeelDrive repeat_recording(const std::string& folder, const Scene& scene, const FeelSettings& settings,
                           const Observer& observer) {
  observer.update("reading", 0.0);
  if (!fs::exists(fs::path(folder) / "recording.json") && fs::exists(fs::path(folder) / "trajectory.csv")) {
    throw Error(printable(folder, 200) +
                ": is a result, not a recording; its trajectory.csv can be rendered with --mapped");
  }
  const Recording recording = read_recording(folder, {}, observer);
  FeelDrive out;
  try {
    ScanDrive scan;
    const Scene* over = &scene;
    Scene placed;
    if (const std::optional<Pose> own = pose_in_scene(scene, folder)) {
      placed = scene;
      placed.T_mesh_world = own;
      over = &placed;
    }
    scan.measured = measure_on_scene(recording, *over, settings.process, observer);
    scan.pressed = press_in_scan(scan.measured, *over, settings.render.stiffness_N_per_m);
    out.path = scan.pressed.path;
    out.problems = scan.measured.problems;
    out.scan = std::move(scan);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    throw Error(printable(folder, 200) + ": " + error.what());
  }
  return out;
}

void cut_path(DevicePath& path, std::int64_t end_ns) {
  if (path.size() == 0 || path.t_ns.back() <= end_ns) return;
  std::size_t hint = 0;
  const Eigen::Vector3d end_m = position_at(path, end_ns, hint);
  const std::size_t keep = hint + (path.t_ns[hint] < end_ns ? 1 : 0);
  path.t_ns.resize(keep);
  path.p_world_m.resize(keep);
  path.t_ns.push_back(end_ns);
  path.p_world_m.push_back(end_m);
}

}  // namespace

void cut_drive(FeelDrive& drive, double duration_s, double rate_Hz) {
  const double ticks = std::ceil(duration_s * rate_Hz * (1.0 - 1e-12));
  const auto end_ns = static_cast<std::int64_t>(std::llround((ticks - 1.0) / rate_Hz * 1e9));
  if (drive.path) cut_path(*drive.path, end_ns);
  if (!drive.stroke) return;
  // Its points are dense: the force of the one before serves the last.
  cut_path(drive.stroke->path, end_ns);
  drive.stroke->press_N.resize(drive.stroke->path.size(), drive.stroke->press_N.back());
}

void check_length(const FeelDrive& drive) {
  constexpr double kLongest_s = 36'000.0;
  if (!drive.path || drive.path->size() == 0) return;
  const double whole_s = 1e-9 * static_cast<double>(drive.path->t_ns.back());
  if (whole_s > kLongest_s) {
    throw Error(fmt::format("--replay: the path takes {:.4g} s, more than ten hours; --duration cuts it", whole_s));
  }
}

FeelDrive read_drive(const std::string& replay, bool mapped, const Scene& scene, const FeelSettings& settings,
                     const Observer& observer) {
  if (fs::is_directory(replay)) return repeat_recording(replay, scene, settings, observer);
  if (mapped && !scene.T_mesh_world) {
    throw Error(
        "--mapped: the scene has no registration (T_mesh_world), so that the position of the tracker's world is not "
        "known; register a scan first");
  }
  const Pose T_scene_path = mapped ? scene.objects.at(0).T_world_mesh * *scene.T_mesh_world : Pose{};
  const ReplayFile file = read_replay_csv(replay);
  FeelDrive out;
  out.path.emplace();
  out.path->t_ns.reserve(file.samples.size());
  out.path->p_world_m.reserve(file.samples.size());
  for (const ReplaySample& sample : file.samples) {
    out.path->t_ns.push_back(sample.t_ns - file.samples.front().t_ns);
    out.path->p_world_m.push_back(mapped ? T_scene_path * sample.p_m : sample.p_m);
  }
  out.problems = file.problems;
  return out;
}

FeelDrive make_drive(const Scene& scene, const std::optional<Eigen::Vector3d>& from_m,
                     const std::optional<Eigen::Vector3d>& to_m, const FeelSettings& settings) {
  constexpr double kAcross_m = 0.08, kSteepest_rad = std::numbers::pi / 3.0;
  FeelDrive out;
  const auto note = [&out](const char* kind, std::string message) { out.problems.push_back({kind, message, 1}); };
  SurfaceLine line;
  if (from_m && to_m) {
    line = line_between(scene, *from_m, *to_m);
    const double steepest = steepest_rad(line);
    if (steepest > kSteepest_rad) {
      note("steep_stroke", fmt::format("the path from --from to --to leads around an edge: the surface is up to "
                                       "{:.0f}° from the direction in which the hand presses",
                                       steepest * 180.0 / std::numbers::pi));
    }
  } else {
    line = textured_line(scene);
    const bool textured = line.size() > 1;
    if (!textured) line = line_across(scene, kAcross_m);
    const bool shorter =
        line.turns_away || (!textured && line.size() > 1 && line.s_m.back() < (1.0 - 1e-9) * kAcross_m);
    line = shortened(line, settings.stroke.margin_m);
    if (shorter && line.size() > 1) {
      note("short_stroke", fmt::format("the stroke is {:.1f} mm long, because the surface {} there",
                                       line.s_m.back() * 1e3, line.turns_away ? "bends away from the hand" : "ends"));
    }
  }
  out.stroke = stroke_along(line, settings.servo.duration_s, settings.stroke);
  return out;
}

}  // namespace asperity
