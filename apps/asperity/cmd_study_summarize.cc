#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/json.h"
#include "asperity/study/format_study_results.h"
#include "asperity/study/study_log.h"
#include "commands.h"

namespace asperity::app {

namespace {

class StudySummarizeCommand : public Command {
 public:
  explicit StudySummarizeCommand(Parser& study)
      : Command(study, "summarize", "Worths, thresholds or ratings from the log of one participant") {
    require(parser().add_option("LOG", log_, "The log of a session, NAME_CODE.study.csv"));
  }

  int run(const Observer& observer) override {
    observer.update("reading", 0.0);
    reads(log_);
    const std::string name = printable(log_, 200);
    if (std::filesystem::is_directory(log_)) throw Error(name + ": is a folder, not the log of a study");
    const StudyLog log = parse_study_log(read_file(log_, kLargestStudyLog_bytes), name);
    observer.update("thresholds and worths", 0.5);
    const StudyResults results = study_results(log.session);
    const std::vector<std::string> open = undetermined(results);
    print_json(to_json(log, results, open).dump_repaired(2));
    say(study_results_text(results));
    if (!quiet()) {
      for (const Problem& problem : log.problems) print_error(problem.message);
    }
    for (const std::string& what : open) print_error("not determined: " + what);
    return open.empty() ? kDone : kNotTrustworthy;
  }

 private:
  Json to_json(const StudyLog& log, const StudyResults& results, const std::vector<std::string>& open) const {
    Json out;
    out["format"] = "asperity-study-results";
    out["version"] = 1;
    out.update(study_results_json(results));
    out["log"] = log_;
    out["problems"] = Json::array();
    for (const Problem& problem : log.problems) out["problems"].push_back(problem.message);
    out["undetermined"] = open;
    out["asperity"] = kVersion;
    return out;
  }

  std::string log_;
};

}  // namespace

std::unique_ptr<Command> make_study_summarize(Parser& study) { return std::make_unique<StudySummarizeCommand>(study); }

}  // namespace asperity::app
