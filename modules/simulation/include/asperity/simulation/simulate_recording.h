#pragma once

#include "asperity/base/problem.h"
#include "asperity/base/progress.h"
#include "asperity/geometry/triangle_mesh.h"
#include "asperity/recording/recording.h"
#include "asperity/simulation/simulation_config.h"
#include "asperity/simulation/surface.h"

namespace asperity {

// A hand scans a surface with a probe in front of a tracker: the raw recording, its calibration as a
// careful person would have measured it, and the truth. The truth has one row for each sample that the
// probe took, at its true time, those that the link lost included. The same config gives the same
// recording. Throws Error for a config that cannot be simulated (an unstable step, an empty band, …) and
// Cancelled.
Recording simulate_recording(const SimulationConfig& config, const Surface& surface, const Observer& observer = {});

// The same over `mesh` (mesh_base.h), along `config.shape.through`; the relief lies along the path. The recording's
// `extra` has the true T_mesh_world as [x,y,z,qw,qx,qy,qz] and the path's length over the mesh.
// Throws Error also for a path that leaves the mesh.
Recording simulate_recording(const SimulationConfig& config, const Surface& surface, const TriangleMesh& mesh,
                             const Observer& observer = {});

// The same on the surface of `config.surface` (make_surface.h) and, if its kind is that, over the mesh of
// `config.shape`; both may read a file. A surface file whose checksum does not hold is a problem ("checksum").
Recording simulate_recording(const SimulationConfig& config, const Observer& observer = {},
                             Problems* problems = nullptr);

}  // namespace asperity
