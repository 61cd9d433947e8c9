#pragma once

#include <string>
#include <utility>
#include <vector>

#include "asperity/batch/batch_plan.h"
#include "asperity/batch/find_scans.h"

namespace asperity {

// A batch for another scheduler. Paths are relative to the plan's folder, but for `program`.
struct WorkflowInput {
  BatchPlan plan;
  std::string plan_file;       // in the plan's folder
  std::string output;          // folder of the results
  std::string folder_from_it;  // the plan's folder as seen from the workflow's
  std::string program;
  std::vector<BatchScan> scans;
};

// Files by their names in the workflow's folder; the last value is true for programs.
struct WorkflowFile {
  std::string name;
  std::string content;
  bool is_program = false;
};

// A workflow of Snakemake 7: Snakefile, scans.json (scans and the files that they are made from), slurm/config.yaml (a
// profile: `snakemake --profile slurm`) and slurm/status.sh (a job's state by scontrol, without accounting). One rule
// does a scan, by `asperity batch PLAN --scan NAME`, and one the summary; an invalid result (3) is a
// result. Throws Error naming a path that Snakemake cannot take (with braces).
std::vector<WorkflowFile> make_snakemake_workflow(const WorkflowInput& input);

// The same for GNU make: Makefile. Throws Error naming a path that make cannot take (with blanks, $#%:;=\ and
// other signs of make or the shell).
std::vector<WorkflowFile> make_make_workflow(const WorkflowInput& input);

}  // namespace asperity
