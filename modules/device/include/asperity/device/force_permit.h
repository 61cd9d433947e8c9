#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>

namespace asperity {

// The leave to command forces, which a program gives to a running loop and has to give again and again: a dead man's
// switch. What its giver forgets, or no longer can give because it hangs, ends by itself: the safety layer then ramps
// the force to zero, and back by its soft start when the leave is there again (docs/safety.md). Nothing is permitted at
// first. renew(), revoke() and limit() are for one thread, the others for the servo's.
class ForcePermit {
 public:
  static constexpr double kLasts_s = 0.25;  // without renewal

  void renew() noexcept { given_.store(++count_, std::memory_order_relaxed); }
  void revoke() noexcept { given_.store(0, std::memory_order_relaxed); }
  // Lowers the largest force from now on; a limit above the config's changes nothing, one that is not a number is zero.
  void limit(double max_force_N) noexcept {
    max_force_N_.store(max_force_N > 0.0 ? max_force_N : 0.0, std::memory_order_relaxed);
  }

  // Another number after each renewal; 0: revoked. Realtime-safe: yes.
  std::uint64_t given() const noexcept { return given_.load(std::memory_order_relaxed); }
  double max_force_N() const noexcept { return max_force_N_.load(std::memory_order_relaxed); }

 private:
  std::uint64_t count_ = 0;
  std::atomic<std::uint64_t> given_{0};
  std::atomic<double> max_force_N_{std::numeric_limits<double>::infinity()};
};

// How long the leave has not been renewed. Begin with PermitWatch{}.
struct PermitWatch {
  std::uint64_t given = 0;
  double silent_s = 0.0;
};

// One tick of the dead man's switch: true while the leave is given. Realtime-safe: yes.
inline bool is_permitted(PermitWatch& watch, const ForcePermit& permit, double dt_s) noexcept {
  const std::uint64_t given = permit.given();
  watch.silent_s = given != watch.given ? 0.0 : std::min(watch.silent_s + dt_s, 2.0 * ForcePermit::kLasts_s);
  watch.given = given;
  return given != 0 && watch.silent_s < ForcePermit::kLasts_s;
}

}  // namespace asperity
