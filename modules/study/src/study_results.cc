#include "asperity/study/study_results.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "asperity/study/bradley_terry.h"
#include "asperity/study/interval.h"
#include "asperity/study/staircase_error.h"

namespace asperity {

using Json = nlohmann::ordered_json;

namespace {

Json share_json(double successes, double trials) {
  const Interval interval = wilson_interval(successes, trials);
  Json out;
  out["count"] = successes;
  out["trials"] = trials;
  out["share"] = trials > 0.0 ? Json(successes / trials) : Json();
  out["low"] = interval.low;
  out["high"] = interval.high;
  return out;
}

Json left_json(const StudySession& session) {
  const auto left = std::count_if(session.answers().begin(), session.answers().end(),
                                  [](const StudyAnswer& answer) { return answer.value == 0; });
  return share_json(static_cast<double>(left), static_cast<double>(session.answers().size()));
}

void add_pairs(Json& out, const StudySession& session) {
  const Eigen::MatrixXd wins = count_wins(session);
  const BradleyTerry fit = fit_bradley_terry(wins);
  Json table = Json::array(), pairs = Json::array(), worths = Json::array();
  for (Eigen::Index i = 0; i < wins.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < wins.cols(); ++j) {
      row.push_back(i == j ? Json() : Json(wins(i, j)));
      if (j <= i) continue;
      Json pair = share_json(wins(i, j), wins(i, j) + wins(j, i));
      pair["first"] = i;
      pair["second"] = j;
      pairs.push_back(std::move(pair));
    }
    table.push_back(std::move(row));
    if (!fit.exists) continue;
    Json worth;
    worth["worth_ln"] = fit.worth_ln(i);
    worth["error_ln"] = std::sqrt(std::max(0.0, fit.covariance(i, i)));
    worths.push_back(std::move(worth));
  }
  out["wins"] = std::move(table);
  out["pairs"] = std::move(pairs);
  out["worths_exist"] = fit.exists;
  out["worths_converged"] = fit.converged;
  out["worths"] = std::move(worths);
  out["left"] = left_json(session);
}

void add_tracks(Json& out, const StudySession& session) {
  Json tracks = Json::array();
  for (std::size_t k = 0; k < session.tracks().size(); ++k) {
    const StaircaseTrack& track = session.tracks()[k];
    const StaircaseThreshold threshold = staircase_threshold(track, session.study().staircase);
    Json each;
    each["stimulus"] = session.stimulus_of(k);
    each["repetition"] = k / session.study().stimuli.size() + 1;
    each["levels"] = track.levels();
    each["correct"] = track.correct();
    each["reversals"] = track.reversal_trials();
    each["done"] = track.done();
    each["threshold"] = threshold.level ? Json(*threshold.level) : Json();
    const auto error_ln =
        threshold.level ? staircase_error_ln(track, *threshold.level, session.study().staircase) : std::nullopt;
    each["error_ln"] = error_ln ? Json(*error_ln) : Json();
    each["pairs"] = threshold.pairs;
    each["at_limit"] = threshold.at_limit;
    tracks.push_back(std::move(each));
  }
  out["target"] = staircase_target(session.study().staircase);
  out["tracks"] = std::move(tracks);
  out["left"] = left_json(session);
}

void add_ratings(Json& out, const StudySession& session) {
  Json ratings = Json::array();
  for (std::size_t k = 0; k < session.study().stimuli.size(); ++k) {
    std::vector<int> values;
    std::array<int, kHighestRating - kLowestRating + 1> counts{};
    for (const StudyAnswer& answer : session.answers()) {
      if (answer.trial.left != static_cast<int>(k)) continue;
      values.push_back(answer.value);
      ++counts.at(static_cast<std::size_t>(answer.value - kLowestRating));
    }
    Json each;
    each["stimulus"] = k;
    each["count"] = values.size();
    each["counts"] = counts;
    if (!values.empty()) {
      const MeanOfRatings mean = mean_of_ratings(values, {kLowestRating, kHighestRating});
      each["mean"] = mean.mean;
      each["deviation"] = values.size() > 1 ? Json(mean.deviation) : Json();
      each["low"] = mean.interval.low;
      each["high"] = mean.interval.high;
    }
    ratings.push_back(std::move(each));
  }
  out["ratings"] = std::move(ratings);
}

}  // namespace

Eigen::MatrixXd count_wins(const StudySession& session) {
  const auto n = static_cast<Eigen::Index>(session.study().stimuli.size());
  Eigen::MatrixXd wins = Eigen::MatrixXd::Zero(n, n);
  for (const StudyAnswer& answer : session.answers()) {
    if (answer.trial.right < 0) continue;
    const bool right = answer.value == 1;
    wins(right ? answer.trial.right : answer.trial.left, right ? answer.trial.left : answer.trial.right) += 1.0;
  }
  return wins;
}

Json study_results(const StudySession& session) {
  const Study& study = session.study();
  Json out;
  out["name"] = study.name;
  out["method"] = kStudyMethodNames.at(static_cast<std::size_t>(study.method));
  out["parameter"] = kStudyParameterNames.at(static_cast<std::size_t>(study.parameter));
  out["question"] = study.question;
  out["object"] = study.object;
  out["participant"] = session.participant();
  out["run"] = session.run();
  out["stimuli"] = study.stimuli;
  out["answers"] = session.answers().size();
  out["whole"] = !session.trial();
  std::vector<double> responses_s;
  for (const StudyAnswer& answer : session.answers()) responses_s.push_back(answer.response_s);
  std::sort(responses_s.begin(), responses_s.end());
  const std::size_t middle = responses_s.size() / 2;
  out["median_response_s"] = responses_s.empty() ? Json()
                             : responses_s.size() % 2 == 1
                                 ? Json(responses_s[middle])
                                 : Json(0.5 * (responses_s[middle - 1] + responses_s[middle]));
  if (study.method == StudyMethod::kPairs) add_pairs(out, session);
  if (study.method == StudyMethod::kStaircase) add_tracks(out, session);
  if (study.method == StudyMethod::kRating) add_ratings(out, session);
  return out;
}

}  // namespace asperity
