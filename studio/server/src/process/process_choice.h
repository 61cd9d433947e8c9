#pragma once

#include <string>
#include <vector>

#include "asperity/pipeline/process_config.h"
#include "asperity/profile/align_passes.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// A recording of the project, or one of its segments.
struct ScanName {
  std::string recording;
  std::string segment;  // one of OpenScan::segments; "": the whole recording, or its first segment
};

// Strokes over one line that are to become one profile.
struct MergeChoice {
  std::vector<std::string> strokes;  // recordings and results of the project
  AlignPassesConfig align;
};

// What the user has decided on the Process page.
struct ProcessChoice {
  std::vector<ScanName> scans;  // the first is the one that others are compared with
  std::size_t current = 0;
  ProcessConfig config;
  MergeChoice merge;
};

inline constexpr std::size_t kMostScans = 16;

// The document's section "process": {"scans":[{"recording","segment"}],"current","config":{path: value as text},
// "merge":{"strokes":[name],"config":{path: value as text}}}; the last may be missing.
Json first_process_section();
Json first_merge();
// Throws Error saying what is wrong with it.
ProcessChoice process_choice(const Json& section);
// A scan as in the section, or as a call's arguments have it.
ScanName scan_name(const Json& json);

}  // namespace asperity::studio
