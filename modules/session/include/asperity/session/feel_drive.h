#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "asperity/base/progress.h"
#include "asperity/fidelity/press_in_scan.h"
#include "asperity/fidelity/surface_stroke.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/scene/scene.h"
#include "asperity/session/feel_settings.h"

namespace asperity {

// A recording that is repeated.
struct ScanDrive {
  ProcessResult measured;
  PressedScan pressed;
};

// What moves the device point of a simulated or replayed device: one of the two.
struct FeelDrive {
  std::optional<DevicePath> path;
  std::optional<HandStroke> stroke;
  std::optional<ScanDrive> scan;  // where `path` comes from a recording
  Problems problems;
};

// The drive of --replay: a recording's folder, repeated over the scene (press_in_scan.h), or a table of positions
// (read_replay_csv.h): in the scene's world, or in the tracker's if `mapped`. Throws Error naming what was read.
FeelDrive read_drive(const std::string& replay, bool mapped, const Scene& scene, const FeelSettings& settings,
                     const Observer& observer);

// The drive of a simulated hand: between two points of the surface if both are given, else along the texture's
// path, or across the object if it has none.
FeelDrive make_drive(const Scene& scene, const std::optional<Eigen::Vector3d>& from_m,
                     const std::optional<Eigen::Vector3d>& to_m, const FeelSettings& settings);

// Ends a drive so that a run has the ticks before `duration_s` and no others, if it is longer.
void cut_drive(FeelDrive& drive, double duration_s, double rate_Hz);

// Throws Error for a path of more than ten hours: a row a tick would fill any disk.
void check_length(const FeelDrive& drive);

}  // namespace asperity
