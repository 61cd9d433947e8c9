#include <algorithm>
#include <cmath>
#include <vector>

#include "line_search.h"

namespace asperity {

namespace {

constexpr std::size_t kMostPairs = 64;
constexpr double kLeastOfPair = 3.0;  // rarity of each, 1 in 20: a line and its neighbours' noise are no pair
// Of a line's share of the power. A relief of many waves has two in this ratio often: of 160, they would be a pair in
// one profile of twelve.
constexpr double kStrongerShares = 2.0, kWeakerShares = 0.25;
constexpr double kPairWaveStep = 1e-2;  // independent frequencies

}  // namespace

// What is asked of the ordinates of a fundamental and of its second harmonic by themselves.
bool LineSearch::may_be_pair(std::size_t bin) const {
  if (bin < 1 || 2 * bin + 2 >= std::min(searched_bins_, power_.size())) return false;
  const double first = power_[bin], second = power_[2 * bin];
  if (!holds_share(std::max(first, second) / kStrongerShares) || !holds_share(std::min(first, second) / kWeakerShares))
    return false;
  const double first_noise = noise_[bin], second_noise = noise_[2 * bin];
  if (!(first_noise > 0.0) || !(second_noise > 0.0)) return true;
  const double least = std::min(first / first_noise, second / second_noise);
  return least > kLeastOfPair &&
         is_rare(first / first_noise + second / second_noise, 2, trials_, hypotheses_.bend_by_range_m * middle_per_m_);
}

bool LineSearch::is_pair(std::size_t bin, double least_of_first) const {
  Wave first{static_cast<double>(bin) / static_cast<double>(kPadding), power_[bin]};
  Wave second{2.0 * first.cycles, power_[2 * bin]};
  Rarities a = rarities_of(first), b = rarities_of(second);
  if (!(a.density > 0.0) || !(b.density > 0.0)) return false;
  // At the frequency between the bins at which both together are highest over their neighbours.
  const double first_density = a.density, second_density = b.density;
  for (double step = 0.5 / static_cast<double>(kPadding); step > kPairWaveStep; step *= 0.5) {
    for (const double cycles : {first.cycles - step, first.cycles + step}) {
      const Wave one{cycles, power_at(x_m_, cycles)}, two{2.0 * cycles, power_at(x_m_, 2.0 * cycles)};
      if (one.power / first_density + two.power / second_density <=
          first.power / first_density + second.power / second_density)
        continue;
      first = one;
      second = two;
      break;
    }
  }
  a = rarities_of(first);
  b = rarities_of(second);
  if (std::min(a.broad, a.narrow) < least_of_first || std::min(b.broad, b.narrow) < kLeastOfPair) return false;
  return are_rare({a.broad + b.broad, a.narrow + b.narrow, 0.0}, 2, first);
}

// The fundamental's bin of the pair with most power, 0 if there is none. Of more than 64 that may be one, the weakest
// are not asked.
std::size_t LineSearch::find_pair(std::size_t first, std::size_t last) const {
  std::vector<std::size_t> bins;
  for (std::size_t bin = std::max<std::size_t>(1, first); bin < last && 2 * bin + 2 < power_.size(); ++bin) {
    if (may_be_pair(bin)) bins.push_back(bin);
  }
  std::sort(bins.begin(), bins.end(), [this](std::size_t x, std::size_t y) {
    const double x_power = power_of_pair(x), y_power = power_of_pair(y);
    return x_power > y_power || (x_power == y_power && x < y);
  });
  bins.resize(std::min(bins.size(), kMostPairs));
  for (const std::size_t bin : bins) {
    if (is_pair(bin, kLeastOfPair)) return bin;
  }
  return 0;
}

bool LineSearch::is_second_of_pair(double length_m) const {
  if (!(length_m > 0.0)) return false;
  // The fundamental's bin is that of half the line's frequency, or one of its neighbours.
  const auto middle = static_cast<std::size_t>(std::lround(0.5 * length_m_ / length_m));
  for (std::size_t bin = middle > 1 ? middle - 1 : 1; bin <= middle + 1; ++bin) {
    if (may_be_pair(bin) && is_pair(bin, -std::log(kByChance))) return true;
  }
  return false;
}

}  // namespace asperity
