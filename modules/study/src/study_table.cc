#include "asperity/study/study_table.h"

#include <cmath>
#include <set>
#include <tuple>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr const char* kTableColumns =
    "study,method,participant,run,trial,repetition,left,right,chosen,rating,comparison,level,correct,response_s,"
    "touch_left_s,touch_right_s,force_left_N,force_right_N\n";

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

// Logs of version 1 have no touches.
std::string touch_cells(const StudyLog& log, const StudyAnswer& answer) {
  if (log.version < 2) return ",,,";
  const bool two = answer.trial.right >= 0;
  const auto cell = [](double value) { return number_text(std::round(1e3 * value) / 1e3); };
  const auto [left, right] = answer.touches;
  return cell(left.touch_s) + ',' + (two ? cell(right.touch_s) : "") + ',' + cell(left.force_N) + ',' +
         (two ? cell(right.force_N) : "");
}

std::string table_row(const StudyLog& log, const StudyAnswer& answer) {
  const StudySession& session = log.session;
  const Study& study = session.study();
  const Trial& trial = answer.trial;
  const bool is_rating = study.method == StudyMethod::kRating;
  const auto name = [&](int stimulus) {
    return stimulus < 0 ? std::string() : quoted(study.stimuli.at(static_cast<std::size_t>(stimulus)));
  };
  std::string out = quoted(study.name) + ',';
  out.append(kStudyMethodNames.at(static_cast<std::size_t>(study.method)));
  out += ',' + quoted(session.participant()) + ',' + std::to_string(session.run()) + ',' +
         std::to_string(trial.number) + ',' + std::to_string(trial.repetition) + ',' + name(trial.left) + ',' +
         name(trial.right) + ',';
  if (!is_rating) out += answer.value == 1 ? "right" : "left";
  out += ',';
  if (is_rating) out += std::to_string(answer.value);
  out += ',';
  if (trial.level) {
    out += std::string(trial.comparison_right ? "right" : "left") + ',' + number_text(*trial.level) + ',' +
           (answer.correct ? "1" : "0");
  } else {
    out += ",,";
  }
  return out + ',' + number_text(answer.response_s) + ',' + touch_cells(log, answer) + '\n';
}

}  // namespace

std::string format_study_table(const std::vector<StudyLog>& logs) {
  std::string out = kTableColumns;
  std::set<std::tuple<std::string, std::string, int>> seen;
  for (const StudyLog& log : logs) {
    const StudySession& session = log.session;
    if (!seen.emplace(session.study().name, session.participant(), session.run()).second) {
      throw Error("two logs are of study " + session.study().name + ", participant " + session.participant() +
                  ", run " + std::to_string(session.run()) + ": give one of them");
    }
    for (const StudyAnswer& answer : session.answers()) out += table_row(log, answer);
  }
  return out;
}

}  // namespace asperity
