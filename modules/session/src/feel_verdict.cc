#include "asperity/session/feel_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "asperity/base/text.h"

namespace asperity {

namespace {

// How far a path stays from the scene, in words.
std::string nearest(const FeelDrive& drive, const RenderModel& model) {
  const DevicePath* path = drive.path ? &*drive.path : drive.stroke ? &drive.stroke->path : nullptr;
  if (path == nullptr || path->size() == 0) return "";
  double least_m = std::numeric_limits<double>::infinity();
  const std::size_t step = 1 + path->size() / 5000;
  for (const RenderObject& object : model.objects) {
    const Pose T_mesh_world = object.T_world_mesh.inverse();
    for (std::size_t i = 0; i < path->size(); i += step) {
      least_m = std::min(least_m, object.bvh.closest_point(T_mesh_world * path->p_world_m[i]).distance_m);
    }
  }
  return fmt::format(": the path comes no nearer to a surface than {:.4g} mm", least_m * 1e3);
}

}  // namespace

RunVerdict judge_run(const FeelStatistics& statistics, const ServoResult& servo, const HapticDevice& device,
                     const FeelDrive& drive, const RenderModel& model, const SafetyConfig& safety) {
  RunVerdict out;
  const auto ticks = [&](SafetyCause cause) { return statistics.caused(cause); };
  if (servo.end == ServoEnd::kFault) {
    const auto own = kReflexFaultWords[static_cast<std::size_t>(servo.fault)];
    out.reasons.push_back("the device has a fault: " +
                          (own.empty() ? printable(device.fault(), 300) : std::string(own)));
  }
  if (ticks(SafetyCause::kNonFinite) > 0) {
    out.reasons.push_back(fmt::format("the force was ramped to zero: {} ticks had numbers that are not finite",
                                      ticks(SafetyCause::kNonFinite)));
  }
  if (ticks(SafetyCause::kStale) > 0) {
    out.reasons.push_back(fmt::format("the force was ramped to zero: for {} ticks there was no news from the device",
                                      ticks(SafetyCause::kStale)));
  }
  if (ticks(SafetyCause::kImplausible) > 0) {
    out.reasons.push_back(
        fmt::format("the force was ramped to zero: on {} ticks no hand could be where the device said",
                    ticks(SafetyCause::kImplausible)));
  }
  if (ticks(SafetyCause::kForceLimit) > 0) {
    out.warnings.push_back(
        fmt::format("{} ticks were limited to {} N", ticks(SafetyCause::kForceLimit), number_text(safety.max_force_N)));
  }
  if (ticks(SafetyCause::kRateLimit) > 0) {
    out.warnings.push_back(fmt::format("on {} ticks the force changed faster than {} N/s and was slowed",
                                       ticks(SafetyCause::kRateLimit), number_text(safety.max_force_rate_N_per_s)));
  }
  if (servo.statistics.lost_ticks > 0) {
    out.warnings.push_back(fmt::format("{} ticks are missing in the log", servo.statistics.lost_ticks));
  }
  if (statistics.starting_inside() > 0) {
    out.warnings.push_back(
        fmt::format("the point started inside an object: no force for {} ticks, until it had left it",
                    statistics.starting_inside()));
  }
  if (statistics.touching() == 0 && statistics.ticks() > 0)
    out.warnings.push_back("nothing was touched" + nearest(drive, model));
  return out;
}

}  // namespace asperity
