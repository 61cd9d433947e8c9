#include "rounding_of_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "asperity/base/text.h"
#include "text_cells.h"

namespace asperity {
namespace {

// What a number's text states of its precision.
struct Digits {
  int decimals = 0;            // negative: the last digit is of tens, hundreds, …
  int significant = 0;         // 0 of a zero
  std::optional<int> leading;  // power of ten of the first digit that is not 0
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<Digits> digits_of(std::string_view cell) {
  if (!cell_number(cell)) return std::nullopt;
  if (!std::any_of(cell.begin(), cell.end(), is_digit)) return std::nullopt;  // nan, inf
  const std::size_t end = std::min(cell.find_first_of("eE"), cell.size());
  int exponent = 0;
  if (end < cell.size()) {
    constexpr double kMostExponent = 400.0;
    exponent =
        static_cast<int>(std::clamp(parse_double(cell.substr(end + 1)).value_or(0.0), -kMostExponent, kMostExponent));
  }
  Digits out;
  int digits = 0, first = -1, before_point = -1;
  for (const char c : cell.substr(0, end)) {
    if (c == '.' || c == ',') before_point = digits;
    if (!is_digit(c)) continue;
    if (c != '0' && first < 0) first = digits;
    ++digits;
  }
  if (before_point < 0) before_point = digits;
  out.decimals = digits - before_point - exponent;
  if (first >= 0) {
    out.significant = digits - first;
    out.leading = before_point - 1 - first + exponent;
  }
  return out;
}

}  // namespace

double rounding_step_rms(std::string_view text, char separator, std::size_t column) {
  constexpr std::size_t kMostLines = std::size_t{1} << 17;
  std::map<int, double> counts;  // by the power of ten of the first digit
  double zeros = 0.0;
  std::optional<int> decimals;
  int significant = 0;
  for (std::size_t line = 0; line < kMostLines && !text.empty(); ++line) {
    const std::string_view row = trim(text.substr(0, text.find('\n')));
    text.remove_prefix(
        std::min(text.size(), text.find('\n') == std::string_view::npos ? text.size() : text.find('\n') + 1));
    const auto cells = text_cells(row, separator);
    if (cells.size() <= column) continue;
    const auto digits = digits_of(cells[column]);
    if (!digits) continue;
    decimals = std::max(decimals.value_or(digits->decimals), digits->decimals);
    significant = std::max(significant, digits->significant);
    if (digits->leading)
      counts[*digits->leading] += 1.0;
    else
      zeros += 1.0;
  }
  if (!decimals) return 0.0;
  double squares = zeros * std::pow(10.0, -2 * *decimals), count = zeros;
  for (const auto& [leading, of] : counts) {
    squares += of * std::pow(10.0, 2 * std::max(-*decimals, leading - significant + 1));
    count += of;
  }
  return std::sqrt(squares / count);
}

}  // namespace asperity
