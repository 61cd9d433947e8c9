#include "asperity/study/study_results.h"

#include <fmt/format.h>

#include <algorithm>

#include "asperity/base/text.h"
#include "asperity/study/staircase_error.h"

namespace asperity {

namespace {

ShareOfTrials share_of(double count, double trials) { return {count, trials, wilson_interval(count, trials)}; }

ShareOfTrials share_of_left(const StudySession& session) {
  const auto left = std::count_if(session.answers().begin(), session.answers().end(),
                                  [](const StudyAnswer& answer) { return answer.value == 0; });
  return share_of(static_cast<double>(left), static_cast<double>(session.answers().size()));
}

std::optional<double> median_response_s(const StudySession& session) {
  std::vector<double> responses_s;
  for (const StudyAnswer& answer : session.answers()) responses_s.push_back(answer.response_s);
  if (responses_s.empty()) return std::nullopt;
  std::sort(responses_s.begin(), responses_s.end());
  const std::size_t middle = responses_s.size() / 2;
  return responses_s.size() % 2 == 1 ? responses_s[middle] : 0.5 * (responses_s[middle - 1] + responses_s[middle]);
}

PairsResults pairs_of(const StudySession& session) {
  PairsResults out;
  out.wins = count_wins(session);
  out.fit = fit_bradley_terry(out.wins);
  const Eigen::MatrixXd& wins = out.wins;
  for (int i = 0; i < wins.rows(); ++i) {
    for (int j = i + 1; j < wins.cols(); ++j) {
      out.pairs.push_back({i, j, share_of(wins(i, j), wins(i, j) + wins(j, i))});
    }
  }
  return out;
}

StaircaseResults tracks_of(const StudySession& session) {
  const StaircaseConfig& config = session.study().staircase;
  StaircaseResults out;
  out.target = staircase_target(config);
  for (std::size_t k = 0; k < session.tracks().size(); ++k) {
    const StaircaseTrack& track = session.tracks()[k];
    TrackResults each{
        session.stimulus_of(k), k / session.study().stimuli.size() + 1, track, staircase_threshold(track, config), {}};
    if (each.threshold.level) each.error_ln = staircase_error_ln(track, *each.threshold.level, config);
    out.tracks.push_back(std::move(each));
  }
  return out;
}

std::vector<TextureRatings> ratings_of(const StudySession& session) {
  std::vector<TextureRatings> out(session.study().stimuli.size());
  for (const StudyAnswer& answer : session.answers()) {
    TextureRatings& each = out.at(static_cast<std::size_t>(answer.trial.left));
    each.values.push_back(answer.value);
    ++each.counts.at(static_cast<std::size_t>(answer.value - kLowestRating));
  }
  for (TextureRatings& each : out) {
    if (!each.values.empty()) each.mean = mean_of_ratings(each.values, {kLowestRating, kHighestRating});
  }
  return out;
}

std::string why_no_threshold(const StaircaseThreshold& threshold) {
  return threshold.at_limit ? "a reversal is at the lowest or the highest level"
                            : "fewer than two reversals count after the halvings";
}

void add_undetermined_tracks(const StudyResults& results, std::vector<std::string>& out) {
  for (const TrackResults& each : results.staircase->tracks) {
    const std::string name =
        fmt::format("{}, repetition {}",
                    printable(results.study.stimuli.at(static_cast<std::size_t>(each.stimulus)), 200), each.repetition);
    if (!each.threshold.level) {
      out.push_back(fmt::format("threshold of {}: {}", name, why_no_threshold(each.threshold)));
    } else if (!each.error_ln) {
      out.push_back(
          fmt::format("standard error of the threshold of {}: most simulated tracks have no threshold", name));
    }
  }
}

void add_undetermined_ratings(const StudyResults& results, std::vector<std::string>& out) {
  for (std::size_t k = 0; k < results.ratings.size(); ++k) {
    const std::size_t count = results.ratings[k].values.size();
    const std::string name = printable(results.study.stimuli.at(k), 200);
    if (count == 0) out.push_back(fmt::format("mean rating of {}: it has no rating", name));
    if (count == 1) out.push_back(fmt::format("interval of the mean rating of {}: it has one rating", name));
  }
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

StudyResults study_results(const StudySession& session) {
  StudyResults out;
  out.study = session.study();
  out.participant = session.participant();
  out.run = session.run();
  out.answers = session.answers().size();
  out.whole = !session.trial();
  out.median_response_s = median_response_s(session);
  if (out.study.method == StudyMethod::kPairs) out.pairs = pairs_of(session);
  if (out.study.method == StudyMethod::kStaircase) out.staircase = tracks_of(session);
  if (out.study.method == StudyMethod::kRating) {
    out.ratings = ratings_of(session);
  } else {
    out.left = share_of_left(session);
  }
  return out;
}

std::vector<std::string> undetermined(const StudyResults& results) {
  std::vector<std::string> out;
  if (results.answers == 0) return {"all results: no trial is answered"};
  if (results.pairs && !results.pairs->fit.exists) {
    out.emplace_back(
        "worths: some textures won all trials against the others, lost all, or were not compared with them");
  } else if (results.pairs && !results.pairs->fit.converged) {
    out.emplace_back("worths: the iteration did not converge");
  }
  if (results.staircase) add_undetermined_tracks(results, out);
  add_undetermined_ratings(results, out);
  return out;
}

}  // namespace asperity
