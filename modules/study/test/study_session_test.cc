#include "asperity/study/study_session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>
#include <regex>
#include <set>

#include <gmock/gmock.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/json/json.h"
#include "asperity/study/format_study_results.h"
#include "asperity/study/plan_trials.h"
#include "asperity/study/study_file.h"
#include "asperity/study/study_log.h"
#include "asperity/study/study_table.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using testing::HasSubstr;

Study study_of(StudyMethod method, int stimuli, int repetitions) {
  Study out;
  out.method = method;
  out.repetitions = repetitions;
  for (int k = 0; k < stimuli; ++k) out.stimuli.push_back("t" + std::to_string(k) + ".texture.json");
  return out;
}

std::string fault_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& fault) {
    return fault.what();
  }
  return "";
}

// Made-up check sums, as many as there are stimuli.
std::vector<std::uint32_t> crcs_of(const StudySession& session) {
  std::vector<std::uint32_t> out(session.study().stimuli.size(), 0xABCU);
  std::iota(out.begin(), out.end(), 0xABCU);
  return out;
}

// Answers by a rule until the end; the log as it would be written.
std::string answered_log(StudySession session, const std::function<int(const Trial&)>& rule) {
  std::string out = format_log_head(session, crcs_of(session));
  while (session.trial()) {
    out += format_answer_row(session, session.give(rule(*session.trial()), 1.5, 2.0 * session.trial()->number), "");
  }
  return out;
}

TEST(PlanTrials, HasEachPairInBothOrdersOnceARepetition) {
  const std::vector<Trial> trials = plan_trials(study_of(StudyMethod::kPairs, 5, 3), "p01", 1);
  ASSERT_EQ(trials.size(), 60U);
  for (int repetition = 1; repetition <= 3; ++repetition) {
    std::set<std::pair<int, int>> seen;
    for (const Trial& trial : trials) {
      if (trial.repetition == repetition) seen.emplace(trial.left, trial.right);
    }
    EXPECT_EQ(seen.size(), 20U);
    for (const auto& [left, right] : seen) EXPECT_TRUE(left != right && seen.contains({right, left}));
  }
  EXPECT_EQ(trials.front().number, 1);
  EXPECT_EQ(trials.back().number, 60);
}

TEST(PlanTrials, IsTheSameForTheSameAndAnotherForAnother) {
  Study study = study_of(StudyMethod::kPairs, 5, 2);
  const std::vector<Trial> trials = plan_trials(study, "p01", 1);
  EXPECT_EQ(trials, plan_trials(study, "p01", 1));
  EXPECT_NE(trials, plan_trials(study, "p02", 1));
  EXPECT_NE(trials, plan_trials(study, "p01", 2));
  study.seed = 2;
  EXPECT_NE(trials, plan_trials(study, "p01", 1));
}

// Over participants each of the six ordered pairs begins as often as any: χ² with 5 degrees of freedom is below 20.5 in
// 99.9 % of cases.
TEST(PlanTrials, DrawsAllOrdersAlike) {
  const Study study = study_of(StudyMethod::kPairs, 3, 1);
  std::map<std::pair<int, int>, int> first;
  constexpr int kParticipants = 1200;
  for (int k = 0; k < kParticipants; ++k) {
    const Trial trial = plan_trials(study, "p" + std::to_string(k), 1).front();
    ++first[{trial.left, trial.right}];
  }
  double chi2 = 0.0;
  for (const auto& [pair, count] : first) chi2 += std::pow(count - kParticipants / 6.0, 2) / (kParticipants / 6.0);
  EXPECT_EQ(first.size(), 6U);
  EXPECT_LT(chi2, 20.5);
}

TEST(PlanTrials, PutsTheChangeAtEachSideTwiceInFour) {
  const Study study = study_of(StudyMethod::kStaircase, 2, 1);
  const std::vector<bool> sides = plan_sides(study, "p01", 1, 0);
  for (std::size_t k = 0; k + 4 <= sides.size(); k += 4)
    EXPECT_EQ(sides[k] + sides[k + 1] + sides[k + 2] + sides[k + 3], 2);
  EXPECT_NE(sides, plan_sides(study, "p01", 1, 1));
}

TEST(PlanTrials, RefusesWhatCannotBeAsked) {
  EXPECT_THAT(fault_of([] { check_plan(study_of(StudyMethod::kPairs, 1, 1)); }), HasSubstr("two textures"));
  EXPECT_THAT(fault_of([] { check_plan(study_of(StudyMethod::kRating, 0, 1)); }), HasSubstr("no textures"));
  EXPECT_THAT(fault_of([] { check_plan(study_of(StudyMethod::kPairs, 30, 100)); }), HasSubstr("87000 trials"));
}

TEST(StudySession, RatesEachTextureAloneOnceARepetition) {
  StudySession session(study_of(StudyMethod::kRating, 4, 2), "p01", 1);
  EXPECT_EQ(session.planned(), 8);
  EXPECT_THROW(session.give(0, 1.0, 1.0), Error);
  std::map<int, int> seen;
  while (session.trial()) {
    EXPECT_EQ(session.trial()->right, -1);
    ++seen[session.trial()->left];
    session.give(2 + session.trial()->left, 1.0, 1.0);
  }
  for (int k = 0; k < 4; ++k) EXPECT_EQ(seen[k], 2);
  const Json results = study_results_json(study_results(session));
  EXPECT_EQ(results["ratings"][3]["mean"], 5.0);
  EXPECT_EQ(results["ratings"][3]["counts"], Json({0, 0, 0, 0, 2, 0, 0}));
  EXPECT_THROW(session.give(4, 1.0, 1.0), Error);
}

TEST(StudySession, AStaircaseHidesAmongItsTracksAndEnds) {
  Study study = study_of(StudyMethod::kStaircase, 2, 2);
  study.staircase.reversals = 6;
  StudySession session(study, "p01", 1);
  EXPECT_EQ(session.planned(), std::nullopt);
  std::set<int> early;
  while (session.trial()) {
    const Trial trial = *session.trial();
    if (trial.number <= 12) early.insert(trial.track);
    EXPECT_EQ(trial.left, trial.right);
    // Finds the change where it is at least 0.3.
    const bool finds = *trial.level >= 0.3;
    session.give(finds == trial.comparison_right ? 1 : 0, 1.0, 1.0);
  }
  EXPECT_GE(early.size(), 3U);
  const Json results = study_results_json(study_results(session));
  ASSERT_EQ(results["tracks"].size(), 4U);
  for (const Json& track : results["tracks"]) {
    // Between the steps to each side of 0.3.
    EXPECT_NEAR(std::log(track["threshold"].get<double>() / 0.3), 0.0, 0.25 * std::log(2.0));
    EXPECT_TRUE(track["done"].get<bool>());
    EXPECT_EQ(track["levels"].size(), track["correct"].size());
  }
}

TEST(StudySession, TakesTheLastAnswerBackOnce) {
  Study study = study_of(StudyMethod::kStaircase, 2, 1);
  StudySession session(study, "p01", 1);
  EXPECT_FALSE(session.can_take_back());
  for (int k = 0; k < 9; ++k) session.give(k % 2, 1.0, 1.0);
  const Trial before = *session.trial();
  const std::vector<double> levels = session.tracks()[static_cast<std::size_t>(before.track - 1)].levels();
  session.give(0, 1.0, 1.0);
  session.take_back();
  EXPECT_EQ(*session.trial(), before);
  EXPECT_EQ(session.tracks()[static_cast<std::size_t>(before.track - 1)].levels(), levels);
  EXPECT_FALSE(session.can_take_back());
  EXPECT_THROW(session.take_back(), Error);
  session.give(1, 1.0, 1.0);
  EXPECT_TRUE(session.can_take_back());
}

TEST(StudyLog, GivesTheSessionBack) {
  for (const StudyMethod method : {StudyMethod::kPairs, StudyMethod::kStaircase, StudyMethod::kRating}) {
    const StudySession session(study_of(method, 3, 2), "p01", 2);
    const auto rule = [&](const Trial& trial) { return method == StudyMethod::kRating ? 3 : trial.number % 2; };
    const std::string text = answered_log(session, rule);
    StudyLog log = parse_study_log(text, "log");
    EXPECT_FALSE(log.session.trial());
    EXPECT_EQ(log.session.participant(), "p01");
    EXPECT_EQ(log.session.run(), 2);
    EXPECT_EQ(log.textures_crc32, crcs_of(session));
    EXPECT_EQ(study_json(log.session.study()), study_json(session.study()));
    EXPECT_EQ(answered_log(StudySession(log.session.study(), "p01", 2), rule), text);
    EXPECT_EQ(log.whole_bytes, text.size());
    EXPECT_EQ(log.since_begin_s, 2.0 * static_cast<double>(log.session.answers().size()));
  }
}

TEST(StudyLog, GoesOnAfterEachRowAndACutOne) {
  StudySession session(study_of(StudyMethod::kPairs, 3, 1), "p01", 1);
  std::string text = format_log_head(session, crcs_of(session));
  std::vector<std::size_t> ends{text.size()};
  while (session.trial()) {
    text += format_answer_row(session, session.give(session.trial()->number % 2, 0.25, session.trial()->number), "");
    ends.push_back(text.size());
  }
  for (std::size_t bytes = ends.front(); bytes <= text.size(); ++bytes) {
    const StudyLog log = parse_study_log(std::string_view(text).substr(0, bytes), "log");
    const auto rows = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), bytes) - ends.begin()) - 1;
    EXPECT_EQ(log.session.answers().size(), rows);
    EXPECT_EQ(log.whole_bytes, ends[rows]);
    EXPECT_EQ(log.problems.size(), bytes == ends[rows] ? 0U : 1U);
  }
}

TEST(StudyLog, KnowsWhatWasTakenBack) {
  StudySession session(study_of(StudyMethod::kPairs, 2, 2), "p01", 1);
  std::string text = format_log_head(session, crcs_of(session));
  text += format_answer_row(session, session.give(0, 1.0, 1.0), "2026-01-02T03:04:05Z");
  session.take_back();
  text += format_taken_back_row(1, 2.0, "");
  text += format_answer_row(session, session.give(1, 1.0, 3.0), "");
  const StudyLog log = parse_study_log(text, "log");
  ASSERT_EQ(log.session.answers().size(), 1U);
  EXPECT_EQ(log.session.answers()[0].value, 1);
  EXPECT_THAT(fault_of([&] { parse_study_log(text + format_taken_back_row(2, 2.0, ""), "log"); }), HasSubstr("log:6"));
}

TEST(StudyLog, WritesTimesInWholeMilliseconds) {
  StudySession session(study_of(StudyMethod::kPairs, 32, 1), "p01", 1);
  const std::regex milliseconds(R"(answer,.*,,,([0-9]+(\.[0-9]{1,3})?),([0-9]+(\.[0-9]{1,3})?),0,0,0,0,\n)");
  while (session.trial()) {
    const int k = session.trial()->number;
    const std::string row = format_answer_row(session, session.give(0, 1.0 / k, 12.3456 * k), "");
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(row, parts, milliseconds)) << row;
    // Half a millisecond, and what decimals are off as binary numbers.
    EXPECT_NEAR(std::stod(parts[1]), 1.0 / k, 0.5001e-3);
    EXPECT_NEAR(std::stod(parts[3]), 12.3456 * k, 0.5001e-3);
  }
  EXPECT_EQ(format_taken_back_row(1, 1.3939999, ""), "taken_back,1,,,,,,,,,,,1.394,,,,,\n");
  EXPECT_EQ(format_taken_back_row(1, 1.3939999, "", 1), "taken_back,1,,,,,,,,,,,1.394,\n");
}

// Written before times were rounded and textures had check sums.
TEST(StudyLog, ReadsThoseOfBefore) {
  const StudySession session(study_of(StudyMethod::kPairs, 2, 1), "p01", 1);
  std::string text = answered_log(session, [](const Trial&) { return 0; });
  const std::string crcs = R"(,"textures_crc32":{"t0.texture.json":"00000abc","t1.texture.json":"00000abd"})";
  ASSERT_NE(text.find(crcs), std::string::npos) << text;
  text.erase(text.find(crcs), crcs.size());
  text.replace(text.find(",1.5,"), 5, ",1.3940000000000001,");
  const StudyLog log = parse_study_log(text, "log");
  EXPECT_TRUE(log.textures_crc32.empty());
  EXPECT_EQ(log.session.answers().front().response_s, 1.3940000000000001);
}

TEST(StudyLog, HasTimesOfTouchAndForces) {
  StudySession session(study_of(StudyMethod::kPairs, 2, 1), "p01", 1);
  std::string text = format_log_head(session, crcs_of(session));
  const std::array<TileTouch, 2> touches{TileTouch{0.25, 0.5}, TileTouch{1.5004, 1.25}};
  text += format_answer_row(session, session.give(0, 3.0, 3.0, touches), "");
  EXPECT_THAT(text, HasSubstr(",3,3,0.25,1.5,0.5,1.25,\n"));
  const StudyLog log = parse_study_log(text, "log");
  EXPECT_EQ(log.version, 2);
  EXPECT_EQ(log.session.answers().front().touches[0], touches[0]);
  EXPECT_EQ(log.session.answers().front().touches[1], (TileTouch{1.5, 1.25}));
  std::string negative = text;
  negative.replace(negative.find(",0.5,1.25,"), 5, ",-0.5,");
  EXPECT_THAT(fault_of([&] { parse_study_log(negative, "log"); }), HasSubstr("not a force"));
}

// As a program without times of touch wrote them; they are continued in their own columns.
TEST(StudyLog, OfVersion1IsReadAndContinued) {
  StudySession session(study_of(StudyMethod::kPairs, 2, 1), "p01", 1);
  std::string text = format_log_head(session, crcs_of(session));
  text.replace(text.find("study_log 2"), 11, "study_log 1");
  const std::string added = ",touch_left_s,touch_right_s,force_left_N,force_right_N";
  text.erase(text.find(added), added.size());
  text += format_answer_row(session, session.give(1, 1.5, 2.0), "", 1);
  text += format_answer_row(session, session.give(0, 1.5, 4.0), "", 1);
  const StudyLog log = parse_study_log(text, "log");
  EXPECT_EQ(log.version, 1);
  EXPECT_EQ(log.session.answers().size(), 2U);
  EXPECT_EQ(log.session.answers().front().touches[0], TileTouch());
}

TEST(StudyTable, HasARowForEachAnswerOfAllParticipants) {
  const auto log_for = [](const std::string& participant) {
    StudySession session(study_of(StudyMethod::kPairs, 2, 1), participant, 1);
    std::string text = format_log_head(session, crcs_of(session));
    text += format_answer_row(session, session.give(0, 1.0, 1.0, {TileTouch{0.5, 1.0}, TileTouch{0.25, 2.0}}), "");
    session.take_back();
    text += format_taken_back_row(1, 2.0, "");
    text += format_answer_row(session, session.give(1, 1.0, 3.0, {TileTouch{0.5, 1.0}, TileTouch{0.25, 2.0}}), "");
    return parse_study_log(text, "log");
  };
  const std::string table = format_study_table({log_for("p01"), log_for("p02")});
  CsvReader rows(table, "table");
  std::vector<std::string> participants;
  while (rows.next()) {
    participants.emplace_back(rows.cell(rows.require("participant")));
    EXPECT_EQ(rows.cell(rows.require("chosen")), "right");
    EXPECT_EQ(rows.number(rows.require("touch_right_s")), 0.25);
    EXPECT_EQ(rows.number(rows.require("force_right_N")), 2.0);
    EXPECT_TRUE(rows.empty(rows.require("rating")));
  }
  EXPECT_THAT(participants, testing::ElementsAre("p01", "p02"));
  EXPECT_THAT(fault_of([&] { format_study_table({log_for("p01"), log_for("p01")}); }), HasSubstr("give one of them"));
}

TEST(StudyLog, RefusesWhatItIsNot) {
  const StudySession session(study_of(StudyMethod::kPairs, 3, 1), "p01", 1);
  const std::string text = answered_log(session, [](const Trial&) { return 0; });
  const auto fault = [](const std::string& changed) { return fault_of([&] { parse_study_log(changed, "log"); }); };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string out = text;
    out.replace(out.find(from), from.size(), to);
    return fault(out);
  };
  EXPECT_THAT(fault("t_s,x\n1,2\n"), HasSubstr("log:1"));
  EXPECT_THAT(with("event,trial", "event,trail"), HasSubstr("columns"));
  EXPECT_THAT(with("answer,2,", "answer,3,"), HasSubstr("log:4: is not the trial"));
  EXPECT_THAT(with(",,,left,", ",,,both,"), HasSubstr("neither left nor right"));
  EXPECT_THAT(with("\"participant\":\"p01\"", "\"participant\":\"../p\""), HasSubstr("participant"));
  EXPECT_THAT(with("\"seed\":1", "\"seed\":2"), HasSubstr("is not the trial"));
  EXPECT_THAT(with("\"00000abc\"", "\"0000abc\""), HasSubstr("log:1: textures_crc32"));
  EXPECT_THAT(with("\"00000abc\"", "\"0000xabc\""), HasSubstr("log:1: textures_crc32"));
  EXPECT_THAT(with("\"00000abc\"", "2748"), HasSubstr("log:1: textures_crc32"));
  EXPECT_THAT(with("{\"t0.texture.json\":\"", "{\"t9.texture.json\":\""), HasSubstr("log:1: textures_crc32"));
  EXPECT_THAT(fault(text + text.substr(text.rfind("answer"))), HasSubstr("all trials are answered"));
  EXPECT_THAT(with(",1.5,", ",-1,"), HasSubstr("not a time"));
}

TEST(StudyLogFile, IsNewAndGrows) {
  const testkit::TempDir folder;
  const std::filesystem::path file = folder / "a.study.csv";
  {
    StudyLogFile log = StudyLogFile::create(file, "head\n");
    log.append("row\n");
    log.sync();
    EXPECT_EQ(read_file(file, 100), "head\nrow\n");
    EXPECT_THROW(StudyLogFile::create(file, "head\n"), Error);
    EXPECT_THROW(StudyLogFile::open(file, 9), Error);  // one program at a time
  }
  std::ofstream(file, std::ios::app) << "half a r";
  EXPECT_THROW(StudyLogFile::open(file, 5), Error);  // a row came after it was read
  EXPECT_EQ(read_file(file, 100), "head\nrow\nhalf a r");
  StudyLogFile again = StudyLogFile::open(file, 9);
  again.append("next\n");
  EXPECT_EQ(read_file(file, 100), "head\nrow\nnext\n");
}

TEST(StudyFile, ReadsWhatItWrites) {
  Study study = study_of(StudyMethod::kStaircase, 3, 4);
  study.question = "Which \"one\" — A or B?";
  study.parameter = StudyParameter::kFrictionDifference;
  study.staircase.up_weight = 1.0 / 3.0;
  study.presentation.device = "haply";
  const Study read = parse_study_file(format_study_file(study), "a.study.json");
  EXPECT_EQ(format_study_file(read), format_study_file(study));
  EXPECT_EQ(read.question, study.question);
  EXPECT_EQ(read.staircase.up_weight, study.staircase.up_weight);
}

TEST(StudyFile, SaysWhatIsWrong) {
  const auto fault = [&](const std::string& text) { return fault_of([&] { parse_study_file(text, "a.study.json"); }); };
  const auto with = [&](const std::string& rest) { return fault(R"({"format":"asperity.study","version":1,)" + rest); };
  EXPECT_THAT(fault("{"), HasSubstr("a.study.json:1:1: not JSON"));
  EXPECT_THAT(fault("[]"), HasSubstr("is not a study"));
  EXPECT_THAT(fault(R"({"format":"asperity.study","version":2})"), HasSubstr("version"));
  EXPECT_THAT(with(R"("speed":1})"), HasSubstr("speed"));
  EXPECT_THAT(with(R"("seed":1,"seed":2})"), HasSubstr("twice"));
  EXPECT_THAT(with(R"("repetitions":0})"), HasSubstr("repetitions"));
  EXPECT_THAT(with(R"("name":"a/b"})"), HasSubstr("a/b"));
  EXPECT_THAT(with(R"("stimuli":["a,b.png"]})"), HasSubstr("comma"));
  EXPECT_THAT(with(R"("stimuli":["a.png","a.png"]})"), HasSubstr("twice"));
  EXPECT_THAT(with(R"("staircase":{"down":"two"}})"), HasSubstr("staircase.down"));
  EXPECT_THAT(with(R"("method":"guess"})"), HasSubstr("guess"));
  EXPECT_THAT(with(R"("question":")" + std::string(501, 'a') + R"("})"), HasSubstr("question: longer than 500 bytes"));
}

}  // namespace
}  // namespace asperity
