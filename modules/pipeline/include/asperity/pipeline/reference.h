#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "asperity/recording/recording.h"
#include "asperity/trajectory/smooth_object_motion.h"
#include "asperity/trajectory/trajectory_result.h"

namespace asperity {

// What a scan is relative to: the object where its marker body was recorded, and the tracker's world otherwise.
enum class Reference : std::uint8_t { kAuto, kWorld, kObject };
inline constexpr std::array<std::string_view, 3> kReferenceNames{"auto", "world", "object"};

// Makes `trajectory`, of the world, relative to the object if the recording has its body and `reference` allows it:
// then trajectory.object is its motion. Metrics `object_…` and problems say what was found. An object that was hardly
// seen leaves the trajectory in the world, with the metric object_seen_share below 0.02. Throws Error for kObject and
// a recording without the body.
void refer_trajectory(const Recording& recording, Reference reference, const ObjectSmootherConfig& config,
                      TrajectoryResult& trajectory);

// The recording as an observer on the object has it, for the stages behind the trajectory: the probe's poses and the
// truth relative to the object, poses in its gaps left out; gravity by its mean direction. The truth is left out if it
// does not know where the object was.
Recording recording_on_object(const Recording& recording, const TrajectoryResult& trajectory);

}  // namespace asperity
