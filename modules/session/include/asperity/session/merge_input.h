#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/pipeline/merge_results.h"
#include "asperity/recording/recording.h"
#include "asperity/session/rendered_input.h"

namespace asperity {

// The strokes of a merge.
struct MergeInput {
  std::vector<MergeStroke> strokes;
  std::vector<StrokeSource> sources;  // the recordings that they were made from
  std::string object;                 // of the first recording that states one

  // What the result calls its surface.
  std::string title() const { return object.empty() ? "merged" : object; }
};

// What a merge calls its strokes: the last part of each path, or all of it where another one has that. Throws Error for
// a folder without a name.
std::vector<std::string> stroke_names(const std::vector<std::string>& paths);

// True for a folder that `process` has written; others are recordings.
bool is_processed(const std::filesystem::path& folder);

// The settings by which a recording becomes a stroke: its noise stays in the heights, and strokes within it are not
// merged.
ProcessConfig stroke_config(const MergeConfig& config);

// Adds a recording that was processed with stroke_config(). Throws Error naming `folder` if it has no profile.
void add_recorded_stroke(MergeInput& input, const std::filesystem::path& folder, const std::string& name,
                         const Recording& recording, const ProcessResult& result);

// Adds what is in `folder`: a recording, which is processed, or what `process` has written. Throws Error naming folder
// or file as read_recording(), process_recording() and read_stroke() do, and Cancelled.
void add_stroke(MergeInput& input, const std::filesystem::path& folder, const std::string& name,
                const MergeConfig& config, const Observer& observer = {});

}  // namespace asperity
