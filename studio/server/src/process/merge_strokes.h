#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/pipeline/merge_results.h"
#include "asperity/studio/block.h"
#include "process/scan_sessions.h"

namespace asperity::studio {

// A stroke with its position in the file system.
struct NamedStroke {
  std::string name;  // as the merge calls it
  std::filesystem::path folder;
};

// Strokes over one line as one profile.
struct MergedStrokes {
  ProcessResult result;
  MergeConfig config;
  std::string object;
};

// What `asperity merge` makes of the strokes, to the last bit; recordings that are open are not processed again. Throws
// Error naming the folder or file, Advice for fewer than two strokes, and Cancelled.
MergedStrokes merge_strokes(const std::vector<NamedStroke>& strokes, const MergeConfig& config, ScanSessions& sessions,
                            const Observer& observer);

// The merge as a "measured" block (measured_block.h), its result that of result.json, with the strokes on it. Head:
// "gain" {"stroke_noise_rms_m","merged_noise_rms_m","share"} (merge_gain.h); array stroke_texture_m f32
// [strokes, points]: the texture of each of result.passes at the profile's points, nan in gaps and of those left out.
BlockWriter merge_block(const MergedStrokes& merged);

// Writes what `asperity merge … -o OUT` writes, all or nothing. Answers {"notes":[…]}: what is invalid or limited.
// Throws Advice if the strokes are not of one line, Error if `target` is something else than results.
Json write_merged(const std::filesystem::path& target, const MergedStrokes& merged);

}  // namespace asperity::studio
