#include "process/process_page.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/recording/fingerprint.h"
#include "asperity/session/merge_input.h"
#include "asperity/studio/measured_block.h"
#include "config_fields.h"
#include "process/merge_strokes.h"
#include "process/process_choice.h"
#include "process/repeatability_block.h"
#include "process/scan_sessions.h"
#include "process/write_results.h"
#include "write_target.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSection = "process";

std::string title_of(const ScanName& scan) {
  return scan.segment.empty() ? scan.recording : scan.recording + ", " + scan.segment;
}

// The recording's own name, or where that is another's too, all of its path and its segment.
std::string result_name(const ScanName& scan, const std::vector<ScanName>& all) {
  const auto leaf = [](const ScanName& one) { return fs::path(one.recording).filename().string(); };
  const auto same = [&](const ScanName& one) { return leaf(one) == leaf(scan); };
  if (std::count_if(all.begin(), all.end(), same) == 1) return leaf(scan);
  std::string name = scan.recording + (scan.segment.empty() ? "" : "_" + scan.segment);
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

// Throws Advice where there is none.
BlockWriter report_block(const Project& project, const std::string& folder) {
  constexpr std::uint64_t kLargestReport_bytes = 32U << 20U;
  std::string page;
  try {
    page = read_file(project.existing(folder + "/report.html"), kLargestReport_bytes);
  } catch (const Error& error) {
    throw Advice(error.what(), "Write the results again; the report is written with them.");
  }
  BlockWriter block("report");
  block.add("page", std::vector<std::uint8_t>(page.begin(), page.end()));
  return block;
}

class ProcessPage : public Page {
 public:
  explicit ProcessPage(Shared& shared) : shared_(shared), sessions_(std::make_shared<ScanSessions>()) {}

  void bind(Document& document, Calls& calls) override {
    document.add_section(
        kSection, first_process_section(), [](const Json& section) { process_choice(section); },
        [](Json& section) {
          ProcessConfig config;
          use_present_names(section, "config", list_fields("", config));
          if (section.is_object() && !section.contains("merge")) section["merge"] = first_merge();
        });
    calls.add("process.fields", [this](const Request& request) { send_fields(request); });
    calls.add("process.run", [this](const Request& request) { run(request); });
    calls.add("process.compare", [this](const Request& request) { compare(request); });
    calls.add("process.merge", [this](const Request& request) { merge(request); });
    calls.add("process.write_merge", [this](const Request& request) { write_merge(request); });
    calls.add("process.write", [this](const Request& request) { write(request); });
    calls.add("process.report", [this](const Request& request) { hand_out_report(request); });
  }

 private:
  ProcessChoice choice() const { return process_choice(shared_.document.section(kSection)); }

  void send_fields(const Request& request) const {
    ProcessChoice chosen = choice(), defaults;
    request.answer(Json{{"fields", fields_json(list_fields("", chosen.config), list_fields("", defaults.config))},
                        {"merge_fields", fields_json(list_fields("align", chosen.merge.align),
                                                     list_fields("align", defaults.merge.align))}});
  }

  // The newest setting of a scan replaces the one that is computed.
  void run(const Request& request) {
    const ScanName scan = scan_name(request.args());
    const fs::path recording = shared_.project.existing(scan.recording);
    answer_by_job(shared_.jobs, request, "Process " + title_of(scan), "process.run " + title_of(scan),
                  [sessions = sessions_, scan, recording, config = choice().config](const Observer& observer) {
                    observer.update("reading", 0.0);
                    OpenScan& open = sessions->open(recording, scan.segment, observer);
                    const ProcessResult& result = open.session.process(config, observer);
                    const std::string name =
                        open.segment.empty() ? scan.recording : scan.recording + "/" + open.segment;
                    BlockWriter block = measured_block(result, open.session.recording(), name);
                    block.head()["scan"] = {{"recording", scan.recording}, {"segment", open.segment}};
                    block.head()["segments"] = open.segments;
                    return block;
                  });
  }

  void compare(const Request& request) {
    const ProcessChoice chosen = choice();
    if (chosen.scans.size() < 2) {
      throw Advice("there is nothing to compare", "Choose two recordings or more of the same surface.");
    }
    std::vector<fs::path> recordings;
    for (const ScanName& scan : chosen.scans) recordings.push_back(shared_.project.existing(scan.recording));
    answer_by_job(shared_.jobs, request, "Compare recordings", "process.compare",
                  [sessions = sessions_, chosen, recordings](const Observer& observer) {
                    std::vector<RepeatedScan> scans;
                    std::vector<NamedFingerprint> measured_from;
                    std::vector<std::string> names;
                    for (std::size_t i = 0; i < recordings.size(); ++i) {
                      observer.update("reading", static_cast<double>(i) / static_cast<double>(recordings.size()));
                      ProcessSession& session =
                          sessions->open(recordings[i], chosen.scans[i].segment, observer).session;
                      scans.push_back(repeated_scan(session.process(chosen.config, observer), session.recording()));
                      names.push_back(title_of(chosen.scans[i]));
                      measured_from.push_back({names.back(), fingerprint_of(session.recording())});
                    }
                    check_independent(measured_from);
                    const Repeatability measured = measure_repeatability(scans, chosen.config.comparison);
                    return repeatability_block(measured, scans, names, chosen.config.comparison);
                  });
  }

  // The strokes of the document, and how they are merged.
  std::vector<NamedStroke> strokes(const MergeChoice& chosen) const {
    std::vector<std::string> folders;
    for (const std::string& stroke : chosen.strokes) folders.push_back(shared_.project.existing(stroke).string());
    const std::vector<std::string> names = stroke_names(folders);
    std::vector<NamedStroke> out;
    for (std::size_t i = 0; i < folders.size(); ++i) out.push_back({names[i], folders[i]});
    return out;
  }

  void merge(const Request& request) {
    const ProcessChoice chosen = choice();
    answer_by_job(shared_.jobs, request, "Merge strokes", "process.merge",
                  [sessions = sessions_, strokes = strokes(chosen.merge),
                   config = MergeConfig{chosen.merge.align, chosen.config}](const Observer& observer) {
                    return merge_block(merge_strokes(strokes, config, *sessions, observer));
                  });
  }

  void write_merge(const Request& request) {
    const ProcessChoice chosen = choice();
    const std::string name = request.text("name");
    answer_by_job(
        shared_.jobs, request, "Write " + name, "process.write_merge",
        [sessions = sessions_, strokes = strokes(chosen.merge), target = write_target(shared_.project, request),
         config = MergeConfig{chosen.merge.align, chosen.config}, name](const Observer& observer) {
          Json out = write_merged(target, merge_strokes(strokes, config, *sessions, observer));
          out["folder"] = name;
          return out;
        });
  }

  void write(const Request& request) {
    const ProcessChoice chosen = choice();
    if (chosen.scans.empty()) throw Advice("there is nothing to write", "Choose a recording first.");
    const std::string name = request.text("name");
    const fs::path target = write_target(shared_.project, request);
    std::vector<NamedScan> scans;
    for (const ScanName& scan : chosen.scans) {
      scans.push_back({result_name(scan, chosen.scans), shared_.project.existing(scan.recording), scan.segment});
    }
    answer_by_job(shared_.jobs, request, "Write " + name, "process.write",
                  [sessions = sessions_, scans, target, config = chosen.config, name](const Observer& observer) {
                    Json out = write_results(target, scans, config, *sessions, observer);
                    out["folder"] = name;
                    return out;
                  });
  }

  // For the browser to keep and open by itself: it is shown outside of the studio's page and of what that may do.
  void hand_out_report(const Request& request) const {
    answer_in_lane(shared_.jobs, "project", request, "", "",
                   [project = shared_.project, folder = request.text("folder")](const Observer&) {
                     return report_block(project, folder);
                   });
  }

  Shared& shared_;
  std::shared_ptr<ScanSessions> sessions_;  // for the jobs' thread
};

}  // namespace

std::unique_ptr<Page> make_process_page(Shared& shared) { return std::make_unique<ProcessPage>(shared); }

}  // namespace asperity::studio
