#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/batch/batch_summary.h"
#include "asperity/batch/make_workflow.h"
#include "asperity/batch/run_batch.h"
#include "asperity/json/parse_json.h"
#include "commands.h"

namespace asperity::app {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMarker = "asperity-batch.json";
constexpr std::string_view kWorkflowMark = "# Written by `asperity batch";

// The folder of a batch's results, held by one batch at a time. Only files of a batch are written in it.
class BatchFolder {
 public:
  // `of_scheduler`: the scans' folders may be in it before (Snakemake makes them), and several processes may be at work
  // in it.
  BatchFolder(fs::path folder, bool of_scheduler, const std::vector<BatchScan>& scans) : folder_(std::move(folder)) {
    const fs::path marker = folder_ / kMarker;
    std::error_code error;
    if (fs::exists(folder_, error) && !fs::is_directory(folder_, error))
      throw Error(printable(folder_.string(), 200) + ": is not a folder");
    if (!fs::exists(marker, error) && holds_others(of_scheduler ? scans : std::vector<BatchScan>{}))
      throw Error(printable(folder_.string(), 200) +
                  ": holds files that are not of a batch; nothing was written. Choose another output folder");
    fs::create_directories(folder_);
    if (!fs::exists(marker, error)) {
      Json mark{{"format", "asperity-batch"}, {"version", 1}, {"asperity", kVersion}};
      write_file(marker, mark.dump(2) + "\n");
    }
    file_ = ::open(marker.c_str(), O_RDONLY | O_CLOEXEC);
    const int lock = of_scheduler ? LOCK_SH : LOCK_EX;
    if (file_ >= 0 && ::flock(file_, lock | LOCK_NB) == 0) return;
    if (file_ >= 0) ::close(file_);
    throw Error(printable(folder_.string(), 200) + ": another batch is running in this folder");
  }
  ~BatchFolder() { ::close(file_); }
  BatchFolder(const BatchFolder&) = delete;
  BatchFolder& operator=(const BatchFolder&) = delete;

 private:
  // Anything but the folders of these scans and hidden files, which schedulers make.
  bool holds_others(const std::vector<BatchScan>& scans) const {
    std::error_code error;
    for (fs::directory_iterator i(folder_, error), end; !error && i != end; i.increment(error)) {
      const std::string name = i->path().filename().string();
      const bool is_scan = std::any_of(scans.begin(), scans.end(), [&](const BatchScan& scan) {
        return scan.name.substr(0, scan.name.find('/')) == name;
      });
      if (!is_scan && !(name.starts_with('.') && !scans.empty())) return true;
    }
    return false;
  }

  fs::path folder_;
  int file_ = -1;
};

bool is_workflow(const fs::path& folder) {
  for (const char* name : {"Snakefile", "Makefile"}) {
    try {
      if (read_file(folder / name, 64 << 20).starts_with(kWorkflowMark)) return true;
    } catch (const Error&) {
      continue;
    }
  }
  return false;
}

std::string relative_to(const fs::path& path, const fs::path& folder) {
  return fs::absolute(path).lexically_normal().lexically_proximate(fs::absolute(folder).lexically_normal()).string();
}

// A path as a shell reads it back.
std::string for_shell(const std::string& path) {
  if (path.find_first_of(" \t\n$\\'\"*?[]{}|&;<>()`!#~") == std::string::npos) return path;
  std::string out = "'";
  for (const char c : path) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

class BatchCommand : public Command {
 public:
  explicit BatchCommand(Parser& root)
      : Command(root, "batch", "Many recordings through process, texture fit, register and roughness, with a summary") {
    require(parser().add_option("PLAN", inputs_, "A plan, FILE.toml; or recordings, or patterns of their folders"));
    parser().add_option("-o,--output", output_, "Folder of the results, if the plan states none")->type_name("OUT");
    parser()
        .add_option("-j,--jobs", jobs_, "Number of scans at a time; default: one for each processor")
        ->in_range(0, 1024);
    parser().add_option("--scan", scan_, "Process only this scan, without the summary")->type_name("NAME");
    parser().add_flag("--summary", summary_, "Write the summary of the existing results only");
    parser()
        .add_option("--emit", emit_, "Write a workflow for this scheduler and run nothing")
        ->one_of({"snakemake", "make"});
    parser()
        .add_option("--workflow", workflow_, "Folder of the workflow; default: 'workflow' in the folder of the plan")
        ->type_name("DIR");
  }

  int run(const Observer& observer) override {
    read_plan();
    const std::vector<BatchScan> scans = find_scans(plan_.folder, plan_.recordings);
    refuse_clashes(scans);
    if (!emit_.empty()) return emit(scans);
    const BatchFolder folder(plan_.folder / output_, summary_ || !scan_.empty(), scans);
    const fs::path program = fs::read_symlink("/proc/self/exe");
    if (!scan_.empty()) return run_one(find_scan(scans), program, observer);
    if (summary_) return summarise(recorded(scans), 0);
    const int jobs = jobs_ > 0 ? jobs_ : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    std::size_t done_before = 0;
    std::vector<ScanRecord> records;
    for (const ScanOutcome& one : run_batch(plan_, scans, output_, program, jobs, observer, {})) {
      done_before += one.was_up_to_date ? 1 : 0;
      records.push_back(one.record);
    }
    return summarise(records, done_before);
  }

 private:
  void read_plan() {
    const bool is_plan = inputs_.size() == 1 && inputs_[0].ends_with(".toml");
    if (is_plan) {
      const fs::path file(inputs_[0]);
      constexpr std::uint64_t kLargestPlan_bytes = 1 << 20;
      plan_ = parse_batch_plan(read_file(file, kLargestPlan_bytes), inputs_[0]);
      plan_.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
      plan_file_ = file.filename().string();
    } else {
      plan_.recordings = inputs_;
    }
    if (output_.empty()) {
      output_ = plan_.output;
    } else {
      output_ = relative_to(output_, plan_.folder);
    }
    if (output_.empty()) throw UsageError("-o: the folder of the results is missing");
  }

  const BatchScan& find_scan(const std::vector<BatchScan>& scans) const {
    for (const BatchScan& scan : scans) {
      if (scan.name == scan_) return scan;
    }
    throw UsageError("--scan: no recording of the batch is called '" + printable(scan_) + "'");
  }

  int run_one(const BatchScan& scan, const fs::path& program, const Observer& observer) {
    const ScanOutcome outcome = run_scan(plan_, scan, output_, program, observer);
    const StepRecord& last = outcome.record.steps.back();
    if (!last.is_done()) {
      throw Error(
          fmt::format("{}: {} failed ({}): {}", printable(scan.name, 200), last.name, last.exit_code, last.message));
    }
    bool valid = true;
    for (const StepRecord& step : outcome.record.steps) valid &= step.exit_code == 0;
    print_json(format_scan_record(outcome.record));
    say(fmt::format("{}: {}\n", printable(scan.name, 200), valid ? "done" : "done, but the result is invalid"));
    return valid ? kDone : kNotTrustworthy;
  }

  // Results among the recording's own files would change it, and a scan that is called as the summary would hide it.
  void refuse_clashes(const std::vector<BatchScan>& scans) const {
    const fs::path results = fs::weakly_canonical(plan_.folder / output_);
    for (const BatchScan& scan : scans) {
      const fs::path rest = results.lexically_relative(fs::weakly_canonical(plan_.folder / scan.path));
      if (!rest.empty() && *rest.begin() != "..") {
        throw Error(printable(output_, 200) + ": the results cannot be inside the recording '" +
                    printable(scan.path, 200) + "'");
      }
      for (const std::string_view own : {kMarker, std::string_view("summary.csv"), std::string_view("index.html")}) {
        if (scan.name.substr(0, scan.name.find('/')) == own)
          throw Error("a recording cannot be called '" + std::string(own) + "': a batch has a file of that name");
      }
    }
  }

  // What earlier runs have recorded of the scans.
  std::vector<ScanRecord> recorded(const std::vector<BatchScan>& scans) const {
    std::vector<ScanRecord> out;
    for (const BatchScan& scan : scans) {
      ScanRecord record = read_scan_record(plan_.folder / output_ / scan.name / "batch.json");
      record.name = scan.name;
      record.recording = scan.path;
      out.push_back(std::move(record));
    }
    return out;
  }

  int summarise(const std::vector<ScanRecord>& records, std::size_t done_before) {
    const fs::path results = plan_.folder / output_;
    std::vector<SummaryRow> rows;
    for (const ScanRecord& record : records) {
      const std::vector<SummaryRow> more = summarise_scan(record, results);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    write_file(results / "summary.csv", format_summary_csv(rows));
    write_file(results / "index.html", format_summary_page(rows));
    return report(rows, done_before);
  }

  int report(const std::vector<SummaryRow>& rows, std::size_t done_before) {
    Json out{{"format", "asperity-batch"}, {"version", 1}, {"results", Json::array()}};
    std::size_t failed = 0, invalid = 0, limited = 0;
    for (const SummaryRow& row : rows) {
      failed += row.status == "failed" ? 1 : 0;
      invalid += row.status == "invalid" ? 1 : 0;
      limited += row.status == "limited" ? 1 : 0;
      out["results"].push_back({{"name", row.name},
                                {"status", row.status},
                                {"failed_step", row.failed_step},
                                {"message", row.message},
                                {"verdicts", Json(row.codes)}});
      if (row.status == "valid" || row.status == "limited") continue;
      print_error(fmt::format("{}: {}: {}{}", printable(row.name, 200), row.status,
                              row.failed_step.empty() ? "" : row.failed_step + ": ", printable(row.message, 500)));
    }
    out["up_to_date"] = done_before;
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    say(
        fmt::format("{} results: {} valid, {} limited, {} invalid, {} failed; {} scans were up to date\n"
                    "summary in {}\n",
                    rows.size(), rows.size() - failed - invalid - limited, limited, invalid, failed, done_before,
                    printable((plan_.folder / output_ / "summary.csv").lexically_normal().string(), 200)));
    if (failed > 0) return kBadInput;
    return invalid > 0 ? kNotTrustworthy : kDone;
  }

  int emit(const std::vector<BatchScan>& scans) {
    if (plan_file_.empty()) throw UsageError("--emit needs a plan, FILE.toml");
    const fs::path target = workflow_.empty() ? plan_.folder / "workflow" : fs::path(workflow_);
    const WorkflowInput input{
        plan_, plan_file_, output_, relative_to(plan_.folder, target), fs::read_symlink("/proc/self/exe").string(),
        scans};
    OutputFolder folder(target, is_workflow);
    for (const WorkflowFile& file : emit_ == "make" ? make_make_workflow(input) : make_snakemake_workflow(input)) {
      fs::create_directories((folder.path() / file.name).parent_path());
      write_file(folder.path() / file.name, file.content);
      if (file.is_program) fs::permissions(folder.path() / file.name, fs::perms(0755), fs::perm_options::replace);
    }
    commit_output(folder, target.string());
    print_json(
        Json{{"format", "asperity-workflow"}, {"workflow", target.string()}, {"scans", scans.size()}}.dump_repaired(2));
    say(fmt::format("{} scans; {}\n", scans.size(),
                    emit_ == "make"
                        ? "make -C " + for_shell(target.string()) + " -j 2 -k"
                        : "snakemake -s " + for_shell((target / "Snakefile").string()) + " -j 2 --keep-going"));
    return kDone;
  }

  std::vector<std::string> inputs_;
  std::string output_;
  int jobs_ = 0;
  std::string scan_;
  bool summary_ = false;
  std::string emit_;
  std::string workflow_;
  BatchPlan plan_;
  std::string plan_file_;
};

}  // namespace

std::unique_ptr<Command> make_batch(Parser& root) { return std::make_unique<BatchCommand>(root); }

}  // namespace asperity::app
