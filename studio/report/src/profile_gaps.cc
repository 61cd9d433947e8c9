#include "profile_gaps.h"

#include <algorithm>
#include <cmath>

namespace asperity::studio {

namespace {

// Samples of the motion at every s, in order of s, to look a stretch up.
class SamplesAlong {
 public:
  explicit SamplesAlong(const BasePathResult& base) {
    for (std::size_t i = 0; i < base.path.s_m.size(); ++i)
      samples_.push_back({base.path.s_m[i], i < base.contact.size() && base.contact[i] != 0});
    std::sort(samples_.begin(), samples_.end(), [](const Sample& a, const Sample& b) { return a.s_m < b.s_m; });
  }

  std::string why(double from_m, double to_m) const {
    const auto below = [](const Sample& sample, double s_m) { return sample.s_m < s_m; };
    const auto first = std::lower_bound(samples_.begin(), samples_.end(), from_m, below);
    const auto last = std::lower_bound(first, samples_.end(), to_m, below);
    if (first == last) return "no samples there: the motion was too fast, or samples were lost";
    if (std::any_of(first, last, [](const Sample& sample) { return !sample.touching; })) return "the tip did not touch";
    return "the tip was stationary: the heights before and after it do not join";
  }

 private:
  struct Sample {
    double s_m;
    bool touching;
  };
  std::vector<Sample> samples_;
};

}  // namespace

std::vector<ProfileGap> find_gaps(const ProcessResult& result) {
  const Profile& profile = result.profile;
  const auto present = [&](std::size_t i) { return std::isfinite(profile.height_m[i]); };
  std::vector<ProfileGap> gaps;
  if (profile.size() == 0 || result.coverage.gaps == 0) return gaps;
  const SamplesAlong samples(result.base);
  std::size_t last = profile.size();
  while (last > 0 && !present(last - 1)) --last;
  std::size_t i = 0;
  while (i < last && !present(i)) ++i;
  while (i < last) {
    while (i < last && present(i)) ++i;
    if (i == last) break;
    std::size_t end = i;
    while (!present(end)) ++end;
    const double from_m = profile.s_m[i - 1], to_m = profile.s_m[end];
    gaps.push_back({from_m, to_m, samples.why(from_m, to_m)});
    i = end;
  }
  return gaps;
}

}  // namespace asperity::studio
