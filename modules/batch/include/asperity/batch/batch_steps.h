#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/batch/batch_plan.h"
#include "asperity/batch/find_scans.h"

namespace asperity {

// One command of a scan, run in the plan's folder.
struct BatchStep {
  std::string name;                // "process", "texture", "register", "roughness", for a piece of it "texture SEGMENT"
  std::vector<std::string> words;  // of the command line, after `asperity`
  std::vector<std::string> inputs;  // files and folders whose change makes it to be done again
  std::string output;               // file or folder that it writes; of roughness its --json goes there
  bool json_to_output = false;
};

// A scan's folder of results, `OUTPUT/NAME`.
std::filesystem::path scan_folder(const std::string& output, const BatchScan& scan);

// The first command of a scan: its recording to OUTPUT/NAME/process.
BatchStep process_step(const BatchPlan& plan, const BatchScan& scan, const std::string& output);

// What follows, of what process has written: each profile (one, or one for each segment) to
// OUTPUT/NAME/NAME.texture.json and NAME.roughness.json, and the recording to OUTPUT/NAME/register. Empty if the plan
// asks for no more.
std::vector<BatchStep> later_steps(const BatchPlan& plan, const BatchScan& scan, const std::string& output);

// The results that process wrote: "" for process/result.json itself, or the names of the segments' folders.
std::vector<std::string> processed_pieces(const std::filesystem::path& process_folder);

}  // namespace asperity
