#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/batch/batch_steps.h"

namespace asperity {

// What became of a step. Exit codes are those of the commands: 0 done, 3 an invalid result, others failed; 128
// + a signal's number.
struct StepRecord {
  std::string name;
  std::vector<std::string> words;
  std::string inputs;  // their fingerprint
  int exit_code = -1;
  std::string message;  // its last line on standard error

  bool is_done() const { return exit_code == 0 || exit_code == 3; }
};

// OUTPUT/NAME/batch.json: what has been done of a scan, so that a batch continues where it stopped.
struct ScanRecord {
  std::string name;
  std::string recording;
  std::vector<StepRecord> steps;  // in their order; a failed one is the last
};

// The text by which a change of the inputs is noticed: path, size and time of change of each file, of folders all that
// is in them, in the order of their names, as 64 bits of FNV-1a. What does not exist counts as such. Contents are not
// read: a thousand recordings would take minutes.
std::string inputs_fingerprint(const std::filesystem::path& folder, const std::vector<std::string>& inputs);

// True if `record` states that `step` was done with these words and inputs by this version, and its output is there.
bool is_up_to_date(const StepRecord& record, const BatchStep& step, const std::filesystem::path& folder,
                   const std::string& fingerprint);

std::string format_scan_record(const ScanRecord& record);
// Reads it again. A file that is missing, damaged or of another version counts as nothing done.
ScanRecord read_scan_record(const std::filesystem::path& file);

}  // namespace asperity
