#include "process/write_results.h"

#include <exception>
#include <set>

#include "asperity/base/error.h"
#include "asperity/base/folder_content.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/studio/calls.h"
#include "asperity/studio/measured_block.h"
#include "asperity/studio/write_report.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

struct Piece {
  std::string segment;
  std::string name;  // of the result
  fs::path place;    // below the target
};

// What one scan gives: itself, or each of its segments.
std::vector<Piece> pieces_of(const NamedScan& scan, bool alone, ScanSessions& sessions, const Observer& observer) {
  const std::vector<std::string>& segments = sessions.open(scan.recording, scan.segment, observer).segments;
  const fs::path place = alone ? fs::path() : fs::path(scan.name);
  if (!scan.segment.empty() || segments.size() < 2) return {{scan.segment, scan.name, place}};
  std::vector<Piece> out;
  for (const std::string& segment : segments)
    out.push_back({segment, alone ? segment : scan.name + "/" + segment, place / segment});
  return out;
}

void check_names(const std::vector<NamedScan>& scans) {
  std::set<std::string> names;
  for (const NamedScan& scan : scans) {
    if (!names.insert(scan.name).second) {
      throw Advice("two of the recordings have the name '" + printable(scan.name) + "'",
                   "Write each of them into its own folder.");
    }
  }
}

}  // namespace

Json write_results(const fs::path& target, const std::vector<NamedScan>& scans, const ProcessConfig& config,
                   ScanSessions& sessions, const Observer& observer) {
  check_names(scans);
  OutputFolder folder(target, naming_added(is_result_folder));
  Json files = Json::array(), notes = Json::array();
  std::vector<ReportItem> items;
  std::exception_ptr first_fault;
  for (const NamedScan& scan : scans) {
    for (const Piece& piece : pieces_of(scan, scans.size() == 1, sessions, observer)) {
      try {
        ProcessSession& session = sessions.open(scan.recording, piece.segment, observer).session;
        const ProcessResult& result = session.process(config, observer);
        fs::create_directories(folder.path() / piece.place);
        write_result(folder.path() / piece.place, result, session.recording(), piece.name);
        files.push_back(piece.place.generic_string());
        items.push_back({piece.name, measured_block(result, session.recording(), piece.name).take()});
        write_report(folder.path() / piece.place, {items.back()});
        for (const Verdict& verdict : result.verdicts) {
          if (verdict.severity != Severity::kNote) notes.push_back(piece.name + ": " + verdict_line(verdict));
        }
      } catch (const Cancelled&) {
        throw;
      } catch (const Error& fault) {
        if (piece.segment.empty() || !scan.segment.empty()) throw;
        if (!first_fault) first_fault = std::current_exception();
        notes.push_back(piece.name + ": " + fault.what() + "; left out");
      }
    }
  }
  if (files.empty() && first_fault) std::rethrow_exception(first_fault);
  observer.update("writing", 1.0);
  if (items.size() > 1) write_report(folder.path(), items);
  for (const fs::path& kept : folder.commit()) {
    notes.push_back(printable(kept.string(), 200) + " was added there in the meantime; it was kept");
  }
  return {{"files", std::move(files)}, {"notes", std::move(notes)}};
}

}  // namespace asperity::studio
