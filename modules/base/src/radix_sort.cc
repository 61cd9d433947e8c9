#include "asperity/base/radix_sort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <utility>

namespace asperity {

namespace {

constexpr unsigned kDigit_bits = 11, kRadixDigits = 6;
constexpr std::size_t kBuckets = std::size_t{1} << kDigit_bits;
constexpr std::size_t kShort = 2000;  // below, counting costs more than comparing

std::size_t digit_of(std::uint64_t value, unsigned digit) { return (value >> (digit * kDigit_bits)) & (kBuckets - 1); }

// Larger numbers have smaller keys: of a positive number's bits the order is that of the number, of a negative one's
// the reverse.
std::uint64_t falling_key(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const bool negative = (bits >> 63U) != 0;
  return negative ? bits : ~bits & ~(std::uint64_t{1} << 63U);
}

double of_falling_key(std::uint64_t key) {
  const bool negative = (key >> 63U) != 0;
  return std::bit_cast<double>(negative ? key : ~key & ~(std::uint64_t{1} << 63U));
}

}  // namespace

void radix_sort(std::vector<std::uint64_t>& values) {
  if (values.size() < kShort) return std::sort(values.begin(), values.end());
  std::vector<std::array<std::size_t, kBuckets>> counts(kRadixDigits);
  for (const std::uint64_t value : values) {
    for (unsigned digit = 0; digit < kRadixDigits; ++digit) ++counts[digit][digit_of(value, digit)];
  }
  std::vector<std::uint64_t> other(values.size());
  for (unsigned digit = 0; digit < kRadixDigits; ++digit) {
    auto& place = counts[digit];
    if (place[digit_of(values.front(), digit)] == values.size()) continue;  // all the same
    std::size_t before = 0;
    for (std::size_t& count : place) before += std::exchange(count, before);
    for (const std::uint64_t value : values) other[place[digit_of(value, digit)]++] = value;
    values.swap(other);
  }
}

void sort_falling(std::vector<double>& values) {
  if (values.size() < kShort) return std::sort(values.begin(), values.end(), std::greater<>{});
  std::vector<std::uint64_t> keys(values.size());
  std::transform(values.begin(), values.end(), keys.begin(), falling_key);
  radix_sort(keys);
  std::transform(keys.begin(), keys.end(), values.begin(), of_falling_key);
}

}  // namespace asperity
