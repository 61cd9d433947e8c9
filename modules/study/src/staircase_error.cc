#include "asperity/study/staircase_error.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/random.h"

namespace asperity {

namespace {

constexpr int kTracks = 200;
constexpr int kSlopes = 41;
constexpr double kFlattest = 0.4, kSteepest = 12.0;
// What slopes are like before a track is seen: those of discrimination by touch and sight are mostly from 1 to 4.
constexpr double kUsualSlope = 2.0, kUsualSpread_ln = 1.0;
constexpr double kLapse = 1e-3;  // a wrong answer to what is plain must not rule a slope out

// The probability of a right answer to a level: 1/2 + 1/2 (1 - exp(-(level/scale)^slope)), `hardness` being
// (level/scale)^slope where it is the target.
class ModelledObserver {
 public:
  ModelledObserver(double threshold, double target, double slope)
      : threshold_(threshold), hardness_(-std::log(2.0 * (1.0 - target))), slope_(slope) {}
  double right(double level) const {
    const double p = 1.0 - 0.5 * std::exp(-hardness_ * std::pow(level / threshold_, slope_));
    return std::clamp(p, 0.5, 1.0 - kLapse);
  }

 private:
  double threshold_, hardness_, slope_;
};

double log_likelihood(const StaircaseTrack& track, const ModelledObserver& observer) {
  double out = 0.0;
  for (std::size_t k = 0; k < track.levels().size(); ++k) {
    const double p = observer.right(track.levels()[k]);
    out += std::log(track.correct()[k] ? p : 1.0 - p);
  }
  return out;
}

// The mean of ln(slope) after the track was seen.
double likely_slope(const StaircaseTrack& track, double level, double target) {
  double best = -1e300, weights = 0.0, sum_ln = 0.0;
  for (const bool summing : {false, true}) {
    for (int k = 0; k < kSlopes; ++k) {
      const double slope_ln =
          std::log(kFlattest) + std::log(kSteepest / kFlattest) * static_cast<double>(k) / (kSlopes - 1);
      const double off = (slope_ln - std::log(kUsualSlope)) / kUsualSpread_ln;
      const double log_weight =
          log_likelihood(track, ModelledObserver(level, target, std::exp(slope_ln))) - 0.5 * off * off;
      if (!summing) {
        best = std::max(best, log_weight);
        continue;
      }
      weights += std::exp(log_weight - best);
      sum_ln += slope_ln * std::exp(log_weight - best);
    }
  }
  return std::exp(sum_ln / weights);
}

}  // namespace

std::optional<double> staircase_error_ln(const StaircaseTrack& track, double level, const StaircaseConfig& config) {
  const double target = staircase_target(config);
  // Half of the answers are right by chance: a rule that settles there or below has no such observer.
  if (!(target > 0.5)) return std::nullopt;
  const ModelledObserver observer(level, target, likely_slope(track, level, target));
  Random random(1);
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (int k = 0; k < kTracks; ++k) {
    StaircaseTrack simulated(config);
    while (!simulated.done()) simulated.push(random.chance(observer.right(simulated.level())));
    const StaircaseThreshold threshold = staircase_threshold(simulated, config);
    if (!threshold.level) continue;
    const double off_ln = std::log(*threshold.level / level);
    sum += off_ln;
    squares += off_ln * off_ln;
    ++count;
  }
  if (2 * count < kTracks) return std::nullopt;
  return std::sqrt(std::max(0.0, squares - sum * sum / count) / (count - 1));
}

}  // namespace asperity
