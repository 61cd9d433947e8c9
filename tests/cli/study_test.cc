#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "asperity/study/study_log.h"
#include "asperity/study/study_session.h"
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

Study study_of(StudyMethod method, int textures, int repetitions) {
  Study out;
  out.method = method;
  out.repetitions = repetitions;
  for (int k = 0; k < textures; ++k) out.stimuli.push_back(std::string(1, static_cast<char>('a' + k)) + ".png");
  return out;
}

// The log of a session with `answers` answers by a rule, or all of them.
std::string log_of(const Study& study, const std::function<int(const Trial&)>& rule, std::size_t answers = 10'000) {
  StudySession session(study, "p01", 1);
  std::string out = format_log_head(session, std::vector<std::uint32_t>(study.stimuli.size(), 1));
  while (session.trial() && session.answers().size() < answers) {
    out += format_answer_row(session, session.give(rule(*session.trial()), 1.5, session.trial()->number), "");
  }
  return out;
}

// Of two textures the first is preferred in the first `count` trials, then the other.
std::function<int(const Trial&)> prefer_first(int count) {
  return [count](const Trial& trial) { return (trial.number <= count) == (trial.left == 0) ? 0 : 1; };
}

class StudySummarize : public testing::Test {
 protected:
  Outcome summarize(const std::string& log, std::vector<std::string> options = {}) {
    write_text(file_, log);
    std::vector<std::string> words{"study", "summarize", file_};
    words.insert(words.end(), options.begin(), options.end());
    return run(words);
  }
  Json json_of(const std::string& log, int code) {
    const Outcome outcome = summarize(log, {"--json"});
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return Json::parse(outcome.out);
  }

  const testkit::TempDir dir_;
  const std::string file_ = (dir_ / "study_p01.study.csv").string();
};

// Two textures: the worths differ by ln(wins / losses), with a variance of 1 / wins + 1 / losses, half of it in each;
// Wilson's interval of 15 of 20 by its formula.
TEST_F(StudySummarize, GivesWorthsOfPairs) {
  const std::string log = log_of(study_of(StudyMethod::kPairs, 2, 10), prefer_first(15));
  const Json results = json_of(log, 0);
  EXPECT_EQ(results["format"], "asperity-study-results");
  EXPECT_EQ(results["method"], "pairs");
  EXPECT_EQ(results["answers"], 20);
  EXPECT_EQ(results["whole"], true);
  EXPECT_EQ(results["undetermined"], Json::array());
  EXPECT_NEAR(results["worths"][0]["worth_ln"].get<double>(), 0.5 * std::log(3.0), 1e-9);
  EXPECT_NEAR(results["worths"][0]["error_ln"].get<double>(), 0.5 * std::sqrt(1.0 / 15.0 + 1.0 / 5.0), 1e-9);
  EXPECT_EQ(results["wins"], Json::parse("[[null,15.0],[5.0,null]]"));
  EXPECT_NEAR(results["pairs"][0]["low"].get<double>(), 0.5313, 5e-5);
  EXPECT_NEAR(results["pairs"][0]["high"].get<double>(), 0.8881, 5e-5);
  const Outcome text = summarize(log);
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(text.err, "");
  EXPECT_THAT(text.out, HasSubstr("+0.549 ± 0.258  a.png\n"));
  EXPECT_THAT(text.out, HasSubstr("a.png to b.png: 15 of 20, 75.0 % (95 %: 53.1 to 88.8 %)\n"));
  EXPECT_THAT(text.out, HasSubstr("one alone: differences between people are not determined\n"));
}

TEST_F(StudySummarize, SaysThatWorthsOfOneThatWonAlwaysAreNotDetermined) {
  const std::string log = log_of(study_of(StudyMethod::kPairs, 2, 3), prefer_first(6));
  const Json results = json_of(log, 3);
  EXPECT_EQ(results["worths_exist"], false);
  EXPECT_EQ(results["undetermined"].size(), 1U);
  EXPECT_EQ(results["wins"][0][1], 6.0);
  const Outcome text = summarize(log);
  EXPECT_EQ(text.code, 3);
  EXPECT_THAT(text.out, HasSubstr("worths        not determined\n"));
  EXPECT_THAT(text.err, HasSubstr("not determined: worths: "));
}

TEST_F(StudySummarize, SaysThatNothingIsDeterminedWithoutAnswers) {
  for (const StudyMethod method : {StudyMethod::kPairs, StudyMethod::kStaircase, StudyMethod::kRating}) {
    const std::string log = log_of(
        study_of(method, 2, 1), [](const Trial&) { return 0; }, 0);
    const Json results = json_of(log, 3);
    EXPECT_EQ(results["answers"], 0);
    EXPECT_EQ(results["median_response_s"], Json());
    EXPECT_EQ(results["undetermined"], Json({"all results: no trial is answered"}));
    const Outcome text = summarize(log);
    EXPECT_THAT(text.out, HasSubstr("not determined"));
    EXPECT_THAT(text.out, Not(HasSubstr("nan")));
  }
}

// Ratings 3, 4, 4 and 5: mean 4, standard deviation √(2/3), and t of 3 degrees of freedom is 3.1824 at 97.5 %.
TEST_F(StudySummarize, GivesMeansOfRatings) {
  const std::array<int, 4> given{3, 4, 4, 5};
  const auto rule = [&](const Trial& trial) {
    return trial.left == 0 ? given.at(static_cast<std::size_t>(trial.repetition - 1)) : 7;
  };
  const std::string log = log_of(study_of(StudyMethod::kRating, 2, 4), rule);
  const Json first = json_of(log, 0)["ratings"][0];
  EXPECT_EQ(first["counts"], Json({0, 0, 1, 2, 1, 0, 0}));
  EXPECT_EQ(first["mean"], 4.0);
  EXPECT_NEAR(first["high"].get<double>(), 4.0 + 3.182446 * std::sqrt(2.0 / 3.0) / 2.0, 1e-6);
  EXPECT_THAT(summarize(log).out, HasSubstr("a.png: 4.00 (95 %: 2.70 to 5.30), standard deviation 0.82; 4 ratings: "
                                            "0 0 1 2 1 0 0\n"));
}

TEST_F(StudySummarize, SaysThatOneRatingHasNoInterval) {
  const std::string log = log_of(
      study_of(StudyMethod::kRating, 2, 1), [](const Trial&) { return 5; }, 1);
  const Json results = json_of(log, 3);
  EXPECT_EQ(results["whole"], false);
  EXPECT_EQ(results["undetermined"].size(), 2U);
  const Outcome text = summarize(log);
  EXPECT_THAT(text.out, HasSubstr("5.00, 95 % interval not determined; 1 rating: "));
  EXPECT_THAT(text.err, HasSubstr("it has no rating"));
  EXPECT_THAT(text.err, HasSubstr("it has one rating"));
}

// Who finds the change from a level of 0.3 on: between the steps to either side of it, which at the end are √√2.
TEST_F(StudySummarize, GivesTheThresholdOfATrack) {
  const auto rule = [](const Trial& trial) { return (*trial.level >= 0.3) == trial.comparison_right ? 1 : 0; };
  const Study study = study_of(StudyMethod::kStaircase, 1, 1);
  const Json track = json_of(log_of(study, rule), 0)["tracks"][0];
  EXPECT_EQ(track["done"], true);
  EXPECT_NEAR(std::log(track["threshold"].get<double>() / 0.3), 0.0, 0.25 * std::log(2.0));
  EXPECT_GT(track["error_ln"].get<double>(), 0.0);
  EXPECT_THAT(summarize(log_of(study, rule)).out, HasSubstr("with 70.7 % right answers\n"));
  const std::string begun = log_of(study, rule, 6);
  EXPECT_EQ(json_of(begun, 3)["tracks"][0]["threshold"], Json());
  EXPECT_THAT(summarize(begun).err, HasSubstr("fewer than two reversals"));
  // Who never finds it is driven to the highest level.
  const auto guess = [](const Trial& trial) { return trial.comparison_right ? 0 : 1; };
  const Outcome limit = summarize(log_of(study, guess));
  EXPECT_EQ(limit.code, 3);
  EXPECT_THAT(limit.out, HasSubstr("not determined"));
}

TEST_F(StudySummarize, RefusesWhatIsNoLog) {
  const std::string log = log_of(study_of(StudyMethod::kPairs, 3, 1), prefer_first(3));
  const auto refuses = [&](const std::string& text, const std::string& why) {
    const Outcome outcome = summarize(text);
    EXPECT_EQ(outcome.code, 1) << why;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("study_p01.study.csv"));
    EXPECT_THAT(outcome.err, HasSubstr(why));
  };
  refuses("", "is empty");
  refuses("t_s,px_m\n1,2\n", "is not a log of a study");
  refuses("# asperity.study_log 3 {}\n", "is not a log of a study of version 1 or 2");
  refuses("# asperity.study_log 2 {}\n", "study, participant and run are needed");
  refuses(log.substr(0, log.find('\n') + 1), "is cut off before its columns end");
  std::string other = log;
  other.replace(other.find("\"seed\":1"), 8, "\"seed\":2");
  refuses(other, "is not the trial that the study and its seed give");
  EXPECT_EQ(run({"study", "summarize", dir_.path().string()}).code, 1);
  EXPECT_EQ(run({"study", "summarize", (dir_ / "none.csv").string()}).code, 1);
  EXPECT_EQ(run({"study", "summarize"}).code, 2);
  EXPECT_EQ(run({"study"}).code, 2);
}

TEST_F(StudySummarize, LeavesALastRowOutThatWasCutOff) {
  std::string log = log_of(study_of(StudyMethod::kPairs, 2, 2), prefer_first(2));
  log.resize(log.size() - 3);
  const Json results = json_of(log, 0);
  EXPECT_EQ(results["answers"], 3);
  EXPECT_EQ(results["problems"].size(), 1U);
  EXPECT_THAT(summarize(log).err, HasSubstr("was cut off"));
}

}  // namespace
}  // namespace asperity::cli
