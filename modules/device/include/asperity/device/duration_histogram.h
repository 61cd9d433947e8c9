#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace asperity {

// How often durations occurred, in memory of fixed size: every power of two of nanoseconds is cut into 32 equal bins,
// durations below 64 ns have bins of 1 ns. Percentiles are therefore exact to 1/32 of themselves, the maximum exactly.
class DurationHistogram {
 public:
  // Negative durations count as 0. Realtime-safe: yes.
  void add(std::int64_t duration_ns) noexcept;

  std::uint64_t count() const noexcept { return count_; }
  std::int64_t max_ns() const noexcept { return max_ns_; }

  // The smallest bin's end (the maximum at most) that at least `fraction` of the durations do not exceed; 0 if none
  // was added. `fraction` within 0 and 1.
  std::int64_t percentile_ns(double fraction) const noexcept;

 private:
  static constexpr std::size_t kSubBins = 32;
  static constexpr std::size_t kBins = 59 * kSubBins;  // of all positive 64-bit numbers

  static std::size_t bin_of(std::uint64_t duration_ns) noexcept;
  static std::int64_t bin_end_ns(std::size_t bin) noexcept;

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ns_ = 0;
};

}  // namespace asperity
