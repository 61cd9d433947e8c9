#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "asperity/base/text.h"
#include "asperity/study/format_study_results.h"

namespace asperity {

namespace {

constexpr const char* kNotDetermined = "not determined";

// "1 trial", "2 trials"
std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string stimulus_text(const StudyResults& results, std::size_t stimulus) {
  return printable(results.study.stimuli.at(stimulus), 200);
}

// "5 of 6, 83.3 % (95 %: 43.6 to 97.0 %)"
std::string share_text(const ShareOfTrials& share) {
  if (!share.share()) return fmt::format("no trials, {}", kNotDetermined);
  return fmt::format("{:.0f} of {:.0f}, {:.1f} % (95 %: {:.1f} to {:.1f} %)", share.count, share.trials,
                     100.0 * *share.share(), 100.0 * share.interval.low, 100.0 * share.interval.high);
}

std::string head_text(const StudyResults& results) {
  const Study& study = results.study;
  std::string out =
      fmt::format("study         {}, {}: {}\n", printable(study.name),
                  kStudyMethodNames.at(static_cast<std::size_t>(study.method)), printable(study.question, 500));
  out += fmt::format("participant   {}, run {}; one alone: differences between people are {}\n",
                     printable(results.participant), results.run, kNotDetermined);
  out += fmt::format("answers       {}, {}", results.answers, results.whole ? "all trials" : "not all trials");
  if (results.median_response_s) out += fmt::format("; half of them within {:.3g} s", *results.median_response_s);
  return out + "\n";
}

std::string pairs_text(const StudyResults& results) {
  const PairsResults& pairs = *results.pairs;
  std::string out = "left          " + share_text(results.left) + "\n";
  if (!pairs.fit.exists) {
    out += fmt::format("worths        {}\n", kNotDetermined);
  } else {
    out += fmt::format("worths        ln, mean 0, with standard error{}\n",
                       pairs.fit.converged ? "" : "; the iteration did not converge");
    for (Eigen::Index i = 0; i < pairs.fit.worth_ln.size(); ++i) {
      out += fmt::format("  {:+.3f} ± {:.3f}  {}\n", pairs.fit.worth_ln(i),
                         std::sqrt(std::max(0.0, pairs.fit.covariance(i, i))),
                         stimulus_text(results, static_cast<std::size_t>(i)));
    }
  }
  out += "pairs         the first was preferred\n";
  for (const PairOfTextures& pair : pairs.pairs) {
    out += fmt::format("  {} to {}: {}\n", stimulus_text(results, static_cast<std::size_t>(pair.first)),
                       stimulus_text(results, static_cast<std::size_t>(pair.second)), share_text(pair.wins));
  }
  return out;
}

std::string threshold_text(const TrackResults& track) {
  if (!track.threshold.level) return kNotDetermined;
  const std::string error =
      track.error_ln ? fmt::format("{:.3g} as a factor", std::exp(*track.error_ln)) : kNotDetermined;
  return fmt::format("{:.4g}, standard error {}", *track.threshold.level, error);
}

std::string staircase_text(const StudyResults& results) {
  const StaircaseResults& staircase = *results.staircase;
  std::string out = "left          " + share_text(results.left) + "\n";
  out +=
      fmt::format("thresholds    level ({}) with {:.1f} % right answers\n",
                  kStudyParameterNames.at(static_cast<std::size_t>(results.study.parameter)), 100.0 * staircase.target);
  for (const TrackResults& track : staircase.tracks) {
    out += fmt::format(
        "  {}, repetition {}: {}; {}, {}{}\n", stimulus_text(results, static_cast<std::size_t>(track.stimulus)),
        track.repetition, threshold_text(track), counted(track.track.levels().size(), "trial"),
        counted(track.track.reversal_trials().size(), "reversal"), track.track.done() ? "" : ", not at its end");
  }
  return out;
}

std::string mean_text(const TextureRatings& ratings) {
  if (!ratings.mean) return kNotDetermined;
  const MeanOfRatings& mean = *ratings.mean;
  if (ratings.values.size() < 2) return fmt::format("{:.2f}, 95 % interval {}", mean.mean, kNotDetermined);
  return fmt::format("{:.2f} (95 %: {:.2f} to {:.2f}), standard deviation {:.2f}", mean.mean, mean.interval.low,
                     mean.interval.high, mean.deviation);
}

std::string ratings_text(const StudyResults& results) {
  std::string out =
      fmt::format("ratings       mean of {} to {}; how often each was given\n", kLowestRating, kHighestRating);
  for (std::size_t k = 0; k < results.ratings.size(); ++k) {
    const TextureRatings& each = results.ratings[k];
    out += fmt::format("  {}: {}; {}: {}\n", stimulus_text(results, k), mean_text(each),
                       counted(each.values.size(), "rating"), fmt::join(each.counts, " "));
  }
  return out;
}

}  // namespace

std::string study_results_text(const StudyResults& results) {
  std::string out = head_text(results);
  if (results.pairs) return out + pairs_text(results);
  if (results.staircase) return out + staircase_text(results);
  return out + ratings_text(results);
}

}  // namespace asperity
