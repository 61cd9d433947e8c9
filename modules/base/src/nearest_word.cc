#include "asperity/base/nearest_word.h"

#include <algorithm>
#include <cstddef>

namespace asperity {

namespace {

std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_word(std::string_view typed, const std::vector<std::string>& known, std::size_t most) {
  constexpr std::size_t kLongest = 200;
  if (typed.empty() || typed.size() > kLongest) return {};
  std::string best;
  std::size_t least = most + 1;
  for (const std::string& word : known) {
    const std::size_t here = distance(typed, word);
    if (here < least && 2 * here < word.size()) least = here, best = word;
  }
  if (!best.empty()) return best;
  const auto begins = [&](const std::string& word) { return word.starts_with(typed); };
  if (std::count_if(known.begin(), known.end(), begins) == 1) return *std::find_if(known.begin(), known.end(), begins);
  return {};
}

}  // namespace asperity
