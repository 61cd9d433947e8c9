#include "asperity/device/duration_histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace asperity {

std::size_t DurationHistogram::bin_of(std::uint64_t duration_ns) noexcept {
  if (duration_ns < 2 * kSubBins) return static_cast<std::size_t>(duration_ns);
  const auto shift = static_cast<std::size_t>(std::bit_width(duration_ns)) - 6;  // leaves 32…63
  return shift * kSubBins + static_cast<std::size_t>(duration_ns >> shift);
}

std::int64_t DurationHistogram::bin_end_ns(std::size_t bin) noexcept {
  if (bin < 2 * kSubBins) return static_cast<std::int64_t>(bin);
  const std::size_t shift = bin / kSubBins - 1;
  const std::uint64_t mantissa = kSubBins + bin % kSubBins;
  return static_cast<std::int64_t>(((mantissa + 1) << shift) - 1);
}

void DurationHistogram::add(std::int64_t duration_ns) noexcept {
  const std::int64_t duration = std::max<std::int64_t>(duration_ns, 0);
  ++bins_[bin_of(static_cast<std::uint64_t>(duration))];
  ++count_;
  max_ns_ = std::max(max_ns_, duration);
}

std::int64_t DurationHistogram::percentile_ns(double fraction) const noexcept {
  if (count_ == 0) return 0;
  const double wanted = std::ceil(fraction * static_cast<double>(count_));
  const std::uint64_t rank = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(wanted), 1, count_);
  std::uint64_t sum = 0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    sum += bins_[bin];
    if (sum >= rank) return std::min(bin_end_ns(bin), max_ns_);
  }
  return max_ns_;
}

}  // namespace asperity
