#include "asperity/batch/run_scan.h"

#include "asperity/base/output.h"
#include "child_process.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

const StepRecord* find_step(const ScanRecord& record, const std::string& name) {
  for (const StepRecord& step : record.steps) {
    if (step.name == name) return &step;
  }
  return nullptr;
}

class ScanRun {
 public:
  ScanRun(const BatchPlan& plan, const BatchScan& scan, const std::string& output, const fs::path& program,
          const Observer& observer)
      : plan_(plan),
        observer_(observer),
        program_(program),
        folder_(plan.folder / scan_folder(output, scan)),
        before_(read_scan_record(folder_ / "batch.json")) {
    out_.record.name = scan.name;
    out_.record.recording = scan.path;
    fs::create_directories(folder_);
  }

  // False if the step failed.
  bool done(const BatchStep& step) {
    const std::string fingerprint = inputs_fingerprint(plan_.folder, step.inputs);
    const StepRecord* earlier = find_step(before_, step.name);
    if (earlier != nullptr && is_up_to_date(*earlier, step, plan_.folder, fingerprint)) {
      out_.record.steps.push_back(*earlier);
      return true;
    }
    out_.was_up_to_date = false;
    StepRecord record{step.name, step.words, fingerprint, -1, ""};
    fs::path log = folder_ / (step.name + ".log");
    const ChildResult child = run_child(
        {program_, step.words, plan_.folder, step.json_to_output ? plan_.folder / step.output : fs::path(), log},
        observer_);
    record.exit_code = child.exit_code;
    record.message = child.last_error_line;
    out_.record.steps.push_back(record);
    write_record();
    return record.is_done();
  }

  // The file has all steps, those too that were up to date after one that was not, and none that the plan has no more.
  ScanOutcome take() {
    const std::size_t recorded = out_.was_up_to_date ? before_.steps.size() : recorded_;
    if (out_.record.steps.size() != recorded) write_record();
    return out_;
  }

 private:
  void write_record() {
    write_file(folder_ / "batch.json", format_scan_record(out_.record));
    recorded_ = out_.record.steps.size();
  }

  const BatchPlan& plan_;
  const Observer& observer_;
  fs::path program_;
  fs::path folder_;
  ScanRecord before_;
  ScanOutcome out_;
  std::size_t recorded_ = 0;  // steps in the file that this run wrote
};

}  // namespace

ScanOutcome run_scan(const BatchPlan& plan, const BatchScan& scan, const std::string& output, const fs::path& program,
                     const Observer& observer) {
  ScanRun run(plan, scan, output, program, observer);
  if (!run.done(process_step(plan, scan, output))) return run.take();
  for (const BatchStep& step : later_steps(plan, scan, output)) {
    if (!run.done(step)) break;
  }
  return run.take();
}

}  // namespace asperity
