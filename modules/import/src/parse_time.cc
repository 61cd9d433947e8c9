#include "parse_time.h"

#include <chrono>
#include <limits>

#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::int64_t kLargest_ns = std::int64_t{1} << 62;
constexpr std::int64_t kSecondInNs = 1'000'000'000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Takes `count` digits from the front.
std::optional<int> take_digits(std::string_view& text, std::size_t count) {
  if (text.size() < count) return std::nullopt;
  int value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_digit(text[i])) return std::nullopt;
    value = 10 * value + (text[i] - '0');
  }
  text.remove_prefix(count);
  return value;
}

bool take_mark(std::string_view& text, char mark) {
  if (!text.starts_with(mark)) return false;
  text.remove_prefix(1);
  return true;
}

// "12:30:00.25" from the front; the seconds may be absent.
std::optional<std::int64_t> take_time_of_day(std::string_view& text) {
  const auto hour = take_digits(text, 2);
  if (!hour || *hour > 23 || !take_mark(text, ':')) return std::nullopt;
  const auto minute = take_digits(text, 2);
  if (!minute || *minute > 59) return std::nullopt;
  std::int64_t out = (std::int64_t{*hour} * 60 + *minute) * 60 * kSecondInNs;
  if (!take_mark(text, ':')) return out;
  const auto second = take_digits(text, 2);
  if (!second || *second > 60) return std::nullopt;
  out += *second * kSecondInNs;
  if (!text.starts_with('.') && !text.starts_with(',')) return out;
  text.remove_prefix(1);
  std::int64_t place = kSecondInNs / 10;
  if (text.empty() || !is_digit(text.front())) return std::nullopt;
  for (; !text.empty() && is_digit(text.front()); text.remove_prefix(1), place /= 10) {
    out += place * (text.front() - '0');
  }
  return out;
}

// "Z", "+02:00", "+0200", "+02" or nothing, as what is to be added to get UTC.
std::optional<std::int64_t> zone_ns(std::string_view text) {
  if (text.empty() || text == "Z" || text == "z") return 0;
  const bool east = text.starts_with('+');
  if (!east && !text.starts_with('-')) return std::nullopt;
  text.remove_prefix(1);
  const auto hours = take_digits(text, 2);
  if (!hours || *hours > 18) return std::nullopt;
  take_mark(text, ':');
  const auto minutes = text.empty() ? std::optional<int>(0) : take_digits(text, 2);
  if (!minutes || *minutes > 59 || !text.empty()) return std::nullopt;
  const std::int64_t ahead = (std::int64_t{*hours} * 60 + *minutes) * 60 * kSecondInNs;
  return east ? -ahead : ahead;
}

}  // namespace

std::optional<std::int64_t> parse_decimal_ns(std::string_view text, std::int64_t unit_ns) {
  text = trim(text);
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  std::int64_t digits = 0;
  int exponent = 0;
  bool behind_mark = false, any = false;
  for (; !text.empty(); text.remove_prefix(1)) {
    const char c = text.front();
    if ((c == '.' || c == ',') && !behind_mark) {
      behind_mark = true;
    } else if (is_digit(c)) {
      any = true;
      if (digits <= (kMost - 9) / 10) {
        digits = 10 * digits + (c - '0');
        exponent -= behind_mark ? 1 : 0;
      } else {
        exponent += behind_mark ? 0 : 1;  // beyond the 18th: too small to matter, or the number too large
      }
    } else {
      break;
    }
  }
  if (!any) return std::nullopt;
  if (text.starts_with('e') || text.starts_with('E')) {
    const auto stated = parse_int64(text.substr(1));
    constexpr std::int64_t kFar = 400;
    if (!stated || *stated < -kFar || *stated > kFar) return std::nullopt;
    exponent += static_cast<int>(*stated);
  } else if (!text.empty()) {
    return std::nullopt;
  }
  if (digits == 0) return 0;
  for (; exponent < 0 && unit_ns % 10 == 0; ++exponent) unit_ns /= 10;  // 1.5 s are 15 times 100 ms
  for (; exponent > 0; --exponent) {
    if (digits > kMost / 10) return std::nullopt;
    digits *= 10;
  }
  std::int64_t last = 0;  // the digit that was cut off last decides how it is rounded
  for (; exponent < 0; ++exponent) {
    last = digits % 10;
    digits /= 10;
  }
  if (last >= 5) ++digits;
  if (digits > kLargest_ns / unit_ns) return std::nullopt;
  return negative ? -digits * unit_ns : digits * unit_ns;
}

std::optional<std::int64_t> parse_date_time_ns(std::string_view text) {
  text = trim(text);
  constexpr std::size_t kLongest = 48;
  if (text.size() < 5 || text.size() > kLongest) return std::nullopt;
  if (text[2] == ':') {
    const auto time = take_time_of_day(text);
    return time && text.empty() ? time : std::nullopt;
  }
  const auto year = take_digits(text, 4);
  const char mark = !text.empty() && text.front() == '/' ? '/' : '-';
  if (!year || *year < 1900 || *year > 2200 || !take_mark(text, mark)) return std::nullopt;
  const auto month = take_digits(text, 2);
  if (!month || !take_mark(text, mark)) return std::nullopt;
  const auto day = take_digits(text, 2);
  if (!day || (!take_mark(text, 'T') && !take_mark(text, ' '))) return std::nullopt;
  using namespace std::chrono;
  const year_month_day date{std::chrono::year{*year}, std::chrono::month{static_cast<unsigned>(*month)},
                            std::chrono::day{static_cast<unsigned>(*day)}};
  if (!date.ok()) return std::nullopt;
  const auto time = take_time_of_day(text);
  if (!time) return std::nullopt;
  const auto zone = zone_ns(trim(text));
  if (!zone) return std::nullopt;
  return sys_days{date}.time_since_epoch().count() * (24 * 3600 * kSecondInNs) + *time + *zone;
}

}  // namespace asperity
