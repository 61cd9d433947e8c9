#include "asperity/batch/make_workflow.h"

#include <algorithm>
#include <filesystem>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/batch/batch_steps.h"
#include "asperity/json/json.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// The files of a folder, relative to the plan's folder; of a file itself.
std::vector<std::string> files_of(const fs::path& folder, const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(folder / path, error)) return {path};
  std::vector<std::string> out;
  for (fs::directory_iterator i(folder / path, error), end; !error && i != end; i.increment(error)) {
    std::error_code ignored;
    const std::string name = i->path().filename().string();
    if (i->is_regular_file(ignored) && !name.starts_with('.')) out.push_back((fs::path(path) / name).string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

// What all scans are made from: the plan, the mesh, files named in options.
std::vector<std::string> common_inputs(const WorkflowInput& input) {
  std::vector<std::string> out{input.plan_file};
  if (!input.plan.mesh.empty()) out.push_back(input.plan.mesh);
  for (const auto* options : {&input.plan.process, input.plan.texture ? &*input.plan.texture : nullptr,
                              input.plan.registration ? &*input.plan.registration : nullptr,
                              input.plan.roughness ? &*input.plan.roughness : nullptr}) {
    if (options == nullptr) continue;
    for (const std::string& path : options->possible_paths()) {
      std::error_code ignored;
      if (fs::is_regular_file(input.plan.folder / path, ignored)) out.push_back(path);
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

constexpr const char* kSnakefile =
    R"(# Written by `asperity batch --emit snakemake`: each recording of the plan by one job, then the summary.
#
#   snakemake -s Snakefile -j 2 --keep-going          on this machine
#   snakemake -s Snakefile --profile slurm            on a cluster (slurm/config.yaml)
#
# Another program: --config asperity=/path/to/asperity
import json
import os

HERE = workflow.basedir
with open(os.path.join(HERE, "scans.json")) as file:
    BATCH = json.load(file)

workdir: os.path.join(HERE, BATCH["folder"])

SCANS = {scan["name"]: scan for scan in BATCH["scans"]}
PROGRAM = config.get("asperity", BATCH["asperity"])
OUTPUT = BATCH["output"]


rule all:
    input:
        os.path.join(OUTPUT, "summary.csv")


# Exit code 3 is an invalid result: the summary states it.
# batch.json is not an output, as Snakemake removes those: it has what was done and why a scan failed.
rule scan:
    input:
        lambda wildcards: SCANS[wildcards.name]["inputs"] + BATCH["inputs"]
    output:
        touch(os.path.join(OUTPUT, "{name}", "batch.done"))
    wildcard_constraints:
        name="|".join(sorted(__import__("re").escape(name) for name in SCANS))
    threads: 1
    params:
        program=PROGRAM, plan=BATCH["plan"], output=OUTPUT
    shell:
        "{params.program:q} batch {params.plan:q} -o {params.output:q} --scan={wildcards.name:q} --quiet || [ $? -eq 3 ]"


rule summary:
    input:
        [os.path.join(OUTPUT, name, "batch.done") for name in SCANS]
    output:
        os.path.join(OUTPUT, "summary.csv"), os.path.join(OUTPUT, "index.html")
    params:
        program=PROGRAM, plan=BATCH["plan"], output=OUTPUT
    shell:
        "{params.program:q} batch {params.plan:q} -o {params.output:q} --summary --quiet || [ $? -eq 3 ]"


# With --keep-going some scans may have failed: the summary lists them.
onerror:
    shell("{PROGRAM:q} batch {BATCH[plan]:q} -o {OUTPUT:q} --summary --quiet || true")
)";

constexpr const char* kSlurmProfile = R"(# A profile for Slurm: snakemake -s Snakefile --profile slurm
cluster: "mkdir -p slurm-logs && sbatch --parsable --job-name=asperity --cpus-per-task={threads} --mem={resources.mem_mb} --time={resources.runtime} --output=slurm-logs/%j.log"
cluster-status: "status.sh"
jobs: 500
keep-going: true
restart-times: 1
latency-wait: 60
default-resources: ["mem_mb=1500", "runtime=30"]
)";

constexpr const char* kSlurmStatus = R"(#!/bin/sh
# Prints "running", "success" or "failed" for the Slurm job $1, by scontrol: no accounting is needed. A job that scontrol
# does not know any more has ended; Snakemake looks for its files. If scontrol does not answer, it is asked again.
if ! answer=$(scontrol show job "$1" 2>&1); then
  case $answer in
    *"Invalid job id"*) echo success ;;
    *) echo running ;;
  esac
  exit 0
fi
state=$(printf '%s\n' "$answer" | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p' | head -n 1)
case $state in
  COMPLETED) echo success ;;
  PENDING | RUNNING | CONFIGURING | COMPLETING | SUSPENDED | REQUEUED | RESIZING | STAGE_OUT) echo running ;;
  *) echo failed ;;
esac
)";

std::string for_make(const std::string& path) {
  // ~ is a home folder where a word begins with it, and - an option.
  if (path.find_first_of(" \t\n\r$#%:;=\\'\"*?[]{}|&<>()`!") != std::string::npos || path.starts_with('~') ||
      path.starts_with('-'))
    throw Error("make cannot take the path '" + printable(path, 200) + "': rename it, or use --emit snakemake");
  return path;
}

// Snakemake takes braces in a file's name for wildcards.
void refuse_braces(const std::string& path) {
  if (path.find_first_of("{}\n") != std::string::npos)
    throw Error("Snakemake cannot take the path '" + printable(path, 200) + "': rename it");
}

}  // namespace

std::vector<WorkflowFile> make_snakemake_workflow(const WorkflowInput& input) {
  Json batch;
  batch["asperity"] = input.program;
  batch["folder"] = input.folder_from_it;
  batch["plan"] = input.plan_file;
  batch["output"] = input.output;
  const std::vector<std::string> common = common_inputs(input);
  batch["inputs"] = Json(common);
  batch["scans"] = Json::array();
  refuse_braces(input.output);
  for (const std::string& path : common) refuse_braces(path);
  for (const BatchScan& scan : input.scans) {
    refuse_braces(scan.name);
    const std::vector<std::string> files = files_of(input.plan.folder, scan.path);
    for (const std::string& path : files) refuse_braces(path);
    batch["scans"].push_back({{"name", scan.name}, {"inputs", Json(files)}});
  }
  return {{"Snakefile", kSnakefile},
          {"scans.json", batch.dump_repaired(1) + "\n"},
          {"slurm/config.yaml", kSlurmProfile},
          {"slurm/status.sh", kSlurmStatus, true}};
}

std::vector<WorkflowFile> make_make_workflow(const WorkflowInput& input) {
  const std::string to_plan = for_make(input.folder_from_it) + "/";
  const auto from_here = [&](const std::string& path) {
    return fs::path(path).is_absolute() ? for_make(path) : to_plan + for_make(path);
  };
  std::string common;
  for (const std::string& path : common_inputs(input)) common += " " + from_here(path);
  std::string out =
      "# Written by `asperity batch --emit make`: make -C FOLDER -j 2 -k; then, if some scans failed, make -C FOLDER "
      "summary\n"
      "ASPERITY ?= " +
      for_make(input.program) + "\n" + "BATCH = cd " + for_make(input.folder_from_it) + " && $(ASPERITY) batch " +
      for_make(input.plan_file) + " -o " + for_make(input.output) + " --quiet\n" + "COMMON =" + common + "\n\n" +
      ".PHONY: all summary\n\n"
      "# Exit code 3 is an invalid result: the summary states it.\n";
  std::string records, rules;
  for (const BatchScan& scan : input.scans) {
    const std::string record = from_here((scan_folder(input.output, scan) / "batch.done").string());
    records += " \\\n  " + record;
    rules += record + ":";
    for (const std::string& file : files_of(input.plan.folder, scan.path)) rules += " " + from_here(file);
    rules += " $(COMMON)\n\t@$(BATCH) --scan " + for_make(scan.name) + " || [ $$? -eq 3 ]\n\t@touch $@\n\n";
  }
  const std::string summary = from_here((fs::path(input.output) / "summary.csv").string());
  out += "all: " + summary + "\n\n" + summary + ":" + records + "\n\t@$(BATCH) --summary || [ $$? -eq 3 ]\n\n" +
         "summary:\n\t@$(BATCH) --summary\n\n" + rules;
  return {{"Makefile", out}};
}

}  // namespace asperity
