#pragma once

#include <array>
#include <cstdint>

namespace asperity {

// Events in the last second, in steps of a tenth.
class RateMeter {
 public:
  explicit RateMeter(std::int64_t now_ns) : step_(now_ns / kStep_ns) {}

  void add(std::int64_t now_ns, std::uint64_t count) {
    move_to(now_ns);
    counts_[slot(step_)] += count;
  }

  // Of the ten whole steps before now.
  double rate_Hz(std::int64_t now_ns) {
    move_to(now_ns);
    std::uint64_t sum = 0;
    for (std::int64_t step = step_ - kSteps; step < step_; ++step) sum += counts_[slot(step)];
    return static_cast<double>(sum);
  }

 private:
  static constexpr std::int64_t kStep_ns = 100'000'000;
  static constexpr std::int64_t kSteps = 10;

  static std::size_t slot(std::int64_t step) { return static_cast<std::size_t>(step % (kSteps + 1)); }

  void move_to(std::int64_t now_ns) {
    const std::int64_t now = now_ns / kStep_ns;
    if (now - step_ > kSteps) {
      counts_.fill(0);
      step_ = now;
    }
    while (step_ < now) counts_[slot(++step_)] = 0;
  }

  std::int64_t step_;
  std::array<std::uint64_t, kSteps + 1> counts_{};
};

}  // namespace asperity
