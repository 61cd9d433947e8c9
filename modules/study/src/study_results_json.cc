#include <algorithm>
#include <cmath>
#include <utility>

#include "asperity/json/json.h"
#include "asperity/study/format_study_results.h"

namespace asperity {

namespace {

template <class Value>
Json value_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

Json share_json(const ShareOfTrials& share) {
  Json out;
  out["count"] = share.count;
  out["trials"] = share.trials;
  out["share"] = value_or_null(share.share());
  out["low"] = share.interval.low;
  out["high"] = share.interval.high;
  return out;
}

void add_pairs(Json& out, const PairsResults& results) {
  Json table = Json::array(), pairs = Json::array(), worths = Json::array();
  for (Eigen::Index i = 0; i < results.wins.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < results.wins.cols(); ++j) row.push_back(i == j ? Json() : Json(results.wins(i, j)));
    table.push_back(std::move(row));
    if (!results.fit.exists) continue;
    Json worth;
    worth["worth_ln"] = results.fit.worth_ln(i);
    worth["error_ln"] = std::sqrt(std::max(0.0, results.fit.covariance(i, i)));
    worths.push_back(std::move(worth));
  }
  for (const PairOfTextures& pair : results.pairs) {
    Json each = share_json(pair.wins);
    each["first"] = pair.first;
    each["second"] = pair.second;
    pairs.push_back(std::move(each));
  }
  out["wins"] = std::move(table);
  out["pairs"] = std::move(pairs);
  out["worths_exist"] = results.fit.exists;
  out["worths_converged"] = results.fit.converged;
  out["worths"] = std::move(worths);
}

void add_tracks(Json& out, const StaircaseResults& results) {
  Json tracks = Json::array();
  for (const TrackResults& track : results.tracks) {
    Json each;
    each["stimulus"] = track.stimulus;
    each["repetition"] = track.repetition;
    each["levels"] = track.track.levels();
    each["correct"] = track.track.correct();
    each["reversals"] = track.track.reversal_trials();
    each["done"] = track.track.done();
    each["threshold"] = value_or_null(track.threshold.level);
    each["error_ln"] = value_or_null(track.error_ln);
    each["pairs"] = track.threshold.pairs;
    each["at_limit"] = track.threshold.at_limit;
    tracks.push_back(std::move(each));
  }
  out["target"] = results.target;
  out["tracks"] = std::move(tracks);
}

Json ratings_json(const std::vector<TextureRatings>& ratings) {
  Json out = Json::array();
  for (std::size_t k = 0; k < ratings.size(); ++k) {
    Json each;
    each["stimulus"] = k;
    each["count"] = ratings[k].values.size();
    each["counts"] = ratings[k].counts;
    if (const auto& mean = ratings[k].mean) {
      each["mean"] = mean->mean;
      each["deviation"] = ratings[k].values.size() > 1 ? Json(mean->deviation) : Json();
      each["low"] = mean->interval.low;
      each["high"] = mean->interval.high;
    }
    out.push_back(std::move(each));
  }
  return out;
}

}  // namespace

Json study_results_json(const StudyResults& results) {
  const Study& study = results.study;
  Json out;
  out["name"] = study.name;
  out["method"] = kStudyMethodNames.at(static_cast<std::size_t>(study.method));
  out["parameter"] = kStudyParameterNames.at(static_cast<std::size_t>(study.parameter));
  out["question"] = study.question;
  out["object"] = study.object;
  out["participant"] = results.participant;
  out["run"] = results.run;
  out["stimuli"] = study.stimuli;
  out["answers"] = results.answers;
  out["whole"] = results.whole;
  out["median_response_s"] = value_or_null(results.median_response_s);
  if (results.pairs) add_pairs(out, *results.pairs);
  if (results.staircase) add_tracks(out, *results.staircase);
  if (results.pairs || results.staircase) {
    out["left"] = share_json(results.left);
  } else {
    out["ratings"] = ratings_json(results.ratings);
  }
  return out;
}

}  // namespace asperity
