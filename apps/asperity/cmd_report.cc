#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"
#include "asperity/session/our_file.h"
#include "asperity/studio/format_report.h"
#include "asperity/studio/read_report_item.h"
#include "commands.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

// What format_report writes first.
bool begins_as_report(std::string_view begin) {
  return begin.starts_with("<!doctype html>\n") &&
         begin.find("<meta name=\"generator\" content=\"Asperity\">\n") != std::string_view::npos;
}

class ReportCommand : public Command {
 public:
  explicit ReportCommand(Parser& root) : Command(root, "report", "Write results as one page for the browser") {
    require(parser().add_option(
        "OUT", folders_,
        "Folders that asperity process or register has written; several results are laid over each other"));
    parser()
        .add_option("-o,--output", output_, "File of the page; default: OUT/report.html, if OUT is one folder")
        ->type_name("FILE.html");
  }

  int run(const Observer& observer) override {
    if (output_.empty() && folders_.size() > 1) throw UsageError("several folders need -o FILE.html");
    const fs::path file = output_.empty() ? fs::path(folders_.front()) / "report.html" : fs::path(output_);
    refuse_stranger(file, begins_as_report, folders_);
    std::vector<studio::ReportItem> items;
    for (const std::string& folder : folders_) {
      for (const fs::path& result : studio::find_results(folder)) {
        observer.update("reading", 0.0);
        items.push_back(studio::read_report_item(result, name_of(folder, result)));
        if (items.size() > studio::kMaxReportItems) {
          throw UsageError("more than " + std::to_string(studio::kMaxReportItems) +
                           " results, too many for one report");
        }
      }
    }
    const std::string page = studio::format_report(items);
    observer.update("writing", 1.0);
    write_file(file, page);
    Json out;
    out["format"] = "asperity-report";
    out["version"] = 1;
    out["file"] = printable(file.string(), 4096);
    for (const studio::ReportItem& item : items) out["results"].push_back(printable(item.name, 200));
    print_json(out.dump(2));
    say("report of " + std::to_string(items.size()) + (items.size() == 1 ? " result" : " results") + " in " +
        printable(file.string(), 200) + "\n");
    return kDone;
  }

 private:
  // A result alone has its recording's name; of several, their folders tell them apart.
  std::string name_of(const std::string& folder, const fs::path& result) const {
    const std::string below = result.lexically_relative(folder).generic_string();
    const bool itself = below.empty() || below == ".";
    if (itself && folders_.size() == 1) return {};
    if (itself) return fs::path(folder).lexically_normal().generic_string();
    return folders_.size() == 1 ? below : (fs::path(folder) / below).lexically_normal().generic_string();
  }

  std::vector<std::string> folders_;
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> make_report(Parser& root) { return std::make_unique<ReportCommand>(root); }

}  // namespace asperity::app
