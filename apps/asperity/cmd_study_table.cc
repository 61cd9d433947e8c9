#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"
#include "asperity/session/our_file.h"
#include "asperity/study/study_table.h"
#include "commands.h"

namespace asperity::app {

namespace {

class StudyTableCommand : public Command {
 public:
  explicit StudyTableCommand(Parser& study)
      : Command(study, "table", "All answers of several participants as one CSV table, for R or a spreadsheet") {
    require(parser().add_option("LOG", logs_, "The logs of sessions, NAME_CODE.study.csv"));
    require(parser().add_option("-o,--output", output_, "The table"))->type_name("FILE.csv");
  }

  int run(const Observer& observer) override {
    const std::string header = format_study_table({});
    refuse_stranger(output_, header, logs_);
    std::vector<StudyLog> logs;
    for (const std::string& log : logs_) {
      observer.update(printable(log, 200), static_cast<double>(logs.size()) / static_cast<double>(logs_.size()));
      reads(log);
      const std::string name = printable(log, 200);
      if (std::filesystem::is_directory(log)) throw Error(name + ": is a folder, not the log of a study");
      logs.push_back(parse_study_log(read_file(log, kLargestStudyLog_bytes), name));
      if (quiet()) continue;
      for (const Problem& problem : logs.back().problems) print_error(problem.message);
    }
    write_file(output_, format_study_table(logs));
    std::size_t answers = 0;
    for (const StudyLog& log : logs) answers += log.session.answers().size();
    Json out = Json::object();
    out["table"] = output_;
    out["logs"] = logs.size();
    out["answers"] = answers;
    print_json(out.dump_repaired(2));
    say(printable(output_, 200) + ": " + counted(answers, "answer") + " of " + counted(logs.size(), "log") + "\n");
    return kDone;
  }

 private:
  static std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
  }

  std::vector<std::string> logs_;
  std::string output_;
};

}  // namespace

std::unique_ptr<Command> make_study_table(Parser& study) { return std::make_unique<StudyTableCommand>(study); }

}  // namespace asperity::app
