#pragma once

#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/studio/block.h"
#include "process/scan_sessions.h"

namespace asperity::studio {

// A scan with its position in the file system.
struct NamedScan {
  std::string name;  // of the recording, its last part
  std::filesystem::path recording;
  std::string segment;
};

// Writes what `asperity process REC… -o OUT` writes, all or nothing: `target` is the folder of the results, those of
// one scan in it, of several in folders of their names; a recording whose segments are apart, and of which none was
// chosen, gives a folder each. What is invalid, limited or left out is named. Answers
// {"files":[results' folders in `target`],"notes":[…]}. Throws Error, and nothing is written, if two recordings have
// the same name, if `target` is something else than results, or if nothing could be processed; and Cancelled.
Json write_results(const std::filesystem::path& target, const std::vector<NamedScan>& scans,
                   const ProcessConfig& config, ScanSessions& sessions, const Observer& observer);

}  // namespace asperity::studio
