#pragma once

#include <filesystem>
#include <string>

#include "asperity/base/progress.h"
#include "asperity/batch/batch_plan.h"
#include "asperity/batch/batch_record.h"

namespace asperity {

struct ScanOutcome {
  ScanRecord record;
  bool was_up_to_date = true;  // nothing had to be done
};

// Does what is still to be done of one scan: each step as a process `program WORDS…` in the plan's folder, its text in
// OUTPUT/NAME/STEP.log, and OUTPUT/NAME/batch.json after each. A step that fails ends the scan; one whose result is not
// to be trusted does not. Other files of the folder stay. Throws Cancelled, once the running step is stopped, and Error
// if a file cannot be written or no process started.
ScanOutcome run_scan(const BatchPlan& plan, const BatchScan& scan, const std::string& output,
                     const std::filesystem::path& program, const Observer& observer);

}  // namespace asperity
