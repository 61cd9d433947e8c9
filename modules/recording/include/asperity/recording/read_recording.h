#pragma once

#include <filesystem>

#include "asperity/base/progress.h"
#include "asperity/recording/read_limits.h"
#include "asperity/recording/recording.h"

namespace asperity {

// Reads a recording folder: recording.json, probe.csv, tracker.csv, the streams of its further bodies,
// calibration.json and, where it exists, truth.csv. The streams returned have strictly rising times and finite values
// (force, gyro and force3 are nan where there is no sample); what had to be repaired or left out is in `problems`.
// Throws Error naming file and line, or file and key, for what cannot be used; Cancelled
// between files and while JSON is read if `observer` says so.
Recording read_recording(const std::filesystem::path& folder, const ReadLimits& limits = {},
                         const Observer& observer = {});

// The same without the tracker and the truth, which need not be there: the probe's streams alone, in the hand with no
// camera in sight.
Recording read_probe_recording(const std::filesystem::path& folder, const ReadLimits& limits = {},
                               const Observer& observer = {});

// calibration.json. Throws Error naming the file and the key.
Calibration read_calibration(const std::filesystem::path& path, const ReadLimits& limits = {},
                             const Observer& observer = {});

// truth.csv; s_m, height_m and force_N may be nan. What was left out is appended to `problems`.
Truth read_truth(const std::filesystem::path& path, Problems& problems, const ReadLimits& limits = {});

// True if the folder holds a recording.json of ours, whatever the state of the rest. Never throws.
bool is_recording_folder(const std::filesystem::path& folder) noexcept;

// True if the folder holds nothing but a recording that can be made again: a simulated or an imported one,
// and no file that is not part of it. A measured one is never overwritten. Never throws.
bool is_replaceable_recording(const std::filesystem::path& folder) noexcept;

}  // namespace asperity
