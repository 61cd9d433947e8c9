#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/base/progress.h"
#include "asperity/fidelity/device_path.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"
#include "asperity/scene/scene.h"

namespace asperity {

// A recorded scan as the path of a device point over a scene; one entry a point in every vector.
struct PressedScan {
  DevicePath path;
  std::vector<double> s_m;               // along the scan path, those of the profile
  std::vector<double> force_N;           // measured, interpolated between the sensor's readings; 0 out of contact
  std::vector<Eigen::Vector3d> n_world;  // outward
  std::vector<double> texture_N_per_m;   // k_c k_s of the place, the spring of a texture there
  std::vector<char> contact;
};

// All that `process` measures of a recording, over the first object of a scene in the place that the scene's
// registration gives it (T_mesh_world). Frames are those of the tracker. Throws Error if the scene has no registration.
ProcessResult measure_on_scene(const Recording& recording, const Scene& scene, const ProcessConfig& config,
                               const Observer& observer = {});

// The path of a device point that repeats a scan: in contact p = b − n F/k, with the base point b, the outward normal n
// and the measured force F of each sample, and the stiffness k of the place (material_at.h; `stiffness_N_per_m` where
// nobody knows); out of contact the tip's own place, not below the surface. The contact force that is rendered there
// is F; a texture adds to it. Before the first sample the point comes down by a millimetre, in 0.1 s, so that it
// does not begin inside. F is the axial reading: a probe held at an angle to the normal reads less than the normal
// force.
// `measured` is of measure_on_scene. Throws Error if it has no base path or no force, or if k is not positive.
PressedScan press_in_scan(const ProcessResult& measured, const Scene& scene, double stiffness_N_per_m);

}  // namespace asperity
