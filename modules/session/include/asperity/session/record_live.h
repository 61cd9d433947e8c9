#pragma once

#include <filesystem>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/link/probe_decoder.h"
#include "asperity/recorder/recorder_snapshot.h"
#include "asperity/recording/recording.h"
#include "asperity/simulation/bench_camera.h"
#include "asperity/simulation/live_bench.h"
#include "asperity/tracking/track_body.h"

namespace asperity {

struct LiveRecording {
  Recording recording;         // what the recorder made of it, with the bench's truth
  double stamp_delay_s = 0.0;  // of the probe's rows (stamp_delay.h)
  LiveReport played;
  RecorderSnapshot recorder;
};

// Plays `scan` live and records it with the real recorder, decoder and tracker: the pseudo-terminal as a serial port,
// the FIFO as a camera. The recording is made in `folder`, the truth put beside it. Throws Error if nothing was
// recorded.
LiveRecording record_live(const Recording& scan, const SimulatedProbeConfig& probe, const LiveBenchConfig& config,
                          const Calibration& calibration, const std::filesystem::path& folder,
                          const Observer& observer);

// The same without a clock's pace: `recording` with the samples that the decoder finds in the probe's bytes, and what
// the probe says of itself.
struct ReceivedProbe {
  Recording recording;
  ProbeDescription description;
};
ReceivedProbe through_link(const Recording& recording, const SimulatedProbeConfig& probe);

// What the tracker finds in all frames of `camera`.
TrackerStream track_frames(BenchCamera& camera, BodyTracker& tracker, const Observer& observer);

}  // namespace asperity
