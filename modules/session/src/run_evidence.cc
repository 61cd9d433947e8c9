#include "asperity/session/run_evidence.h"

#include <algorithm>
#include <limits>

#include "asperity/base/text.h"

namespace asperity {

namespace {

// Least distance of the path from any surface; nan without a path.
double nearest_m(const FeelDrive& drive, const RenderModel& model) {
  const DevicePath* path = drive.path ? &*drive.path : drive.stroke ? &drive.stroke->path : nullptr;
  if (path == nullptr || path->size() == 0) return std::numeric_limits<double>::quiet_NaN();
  double least_m = std::numeric_limits<double>::infinity();
  const std::size_t step = 1 + path->size() / 5000;
  for (const RenderObject& object : model.objects) {
    const Pose T_mesh_world = object.T_world_mesh.inverse();
    for (std::size_t i = 0; i < path->size(); i += step) {
      least_m = std::min(least_m, object.bvh.closest_point(T_mesh_world * path->p_world_m[i]).distance_m);
    }
  }
  return least_m;
}

}  // namespace

RunEvidence run_evidence(const FeelStatistics& statistics, const ServoResult& servo, const HapticDevice& device,
                         const FeelDrive& drive, const RenderModel& model, const SafetyConfig& safety) {
  RunEvidence out;
  if (servo.end == ServoEnd::kFault) {
    const auto own = kReflexFaultWords[static_cast<std::size_t>(servo.fault)];
    out.device_fault = own.empty() ? printable(device.fault(), 300) : std::string(own);
  }
  out.ticks = statistics.ticks();
  out.ticks_not_finite = statistics.caused(SafetyCause::kNonFinite);
  out.ticks_stale = statistics.caused(SafetyCause::kStale);
  out.ticks_implausible = statistics.caused(SafetyCause::kImplausible);
  out.ticks_force_limited = statistics.caused(SafetyCause::kForceLimit);
  out.max_force_N = safety.max_force_N;
  out.ticks_rate_limited = statistics.caused(SafetyCause::kRateLimit);
  out.max_force_rate_N_per_s = safety.max_force_rate_N_per_s;
  out.ticks_unlogged = servo.statistics.lost_ticks;
  out.ticks_starting_inside = statistics.starting_inside();
  out.ticks_touching = statistics.touching();
  if (out.ticks_touching == 0) out.nearest_m = nearest_m(drive, model);
  return out;
}

}  // namespace asperity
