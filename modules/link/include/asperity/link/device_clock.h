#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace asperity {

struct DeviceClockConfig {
  double window_s = 16.0;           // of the device's clock, over which pairs count
  double max_rate_error = 500e-6;   // the device's seconds against the host's: two crystals of 200 ppm and some room
  std::int64_t min_spacing_ns = 1;  // of the times handed out
};

// Maps a device's clock to the host's from pairs (device time p, arrival a on the host), causally and in constant
// memory.
//
// What was sent at p arrives at a = α + β p + w: w >= 0 is how late it came, α + β p the earliest that it could. Bytes
// come late, in bursts even, but never early, so the line wanted lies below all pairs of the window and, in the mean,
// nearest to them:
//
//   maximise Σ (α + β p_i)  subject to  α + β p_i <= a_i for all i,  |β − 1| <= max_rate_error.
//
// The sum is n (α + β p̄), p̄ the mean of the p_i: the line is the edge of the pairs' lower convex hull over p̄ (Moon,
// Skelly and Towsley, INFOCOM 1999), and where its slope is not allowed, the highest allowed line below the hull. A
// pair that came late is above the hull and does not move it; a stretch of late pairs moves it only when it fills
// half the window. Of each 64th of the window the pair with the least a − p is kept: the line may pass a pair that was
// left out by at most max_rate_error · window / 64, 0.13 ms, and does so only while the rate is not known.
//
// The least delay there is (the frame's own transmission, the driver) is a constant in α and cannot be seen.
class DeviceClock {
 public:
  explicit DeviceClock(const DeviceClockConfig& config = {});

  // Adds a pair. A device time before the newest counts as long as it is in the window.
  void observe(std::int64_t device_ns, std::int64_t arrival_ns);

  // The line's host time of a device time; before the first pair the device time itself.
  std::int64_t line_ns(std::int64_t device_ns) const;

  // The line's host time as it is to be handed out: later than all handed out before, restarts included. Where the line
  // moves, the times handed out come to it at half to one and a half times the device's pace, so that rows neither
  // crowd nor part; if they are more than 50 ms behind it, at once.
  std::int64_t stamp(std::int64_t device_ns);

  // Forgets the pairs: the device counts from elsewhere now, or otherwise.
  void restart();
  void restart(const DeviceClockConfig& config);

  // The host's seconds in one of the device's.
  double rate() const { return 1.0 + slope_; }

 private:
  static constexpr std::size_t kBins = 64;
  struct Pair {
    double p_ns = 0.0;  // after origin_ns_
    double r_ns = 0.0;  // arrival − device time, less offset_ns_
  };

  void fit();

  DeviceClockConfig config_;
  double bin_ns_ = 0.0;
  std::array<Pair, kBins + 1> pairs_{};  // by bin, ascending
  std::array<std::int64_t, kBins + 1> bins_{};
  std::size_t count_ = 0;
  std::int64_t origin_ns_ = 0;
  std::int64_t offset_ns_ = 0;
  double slope_ = 0.0;         // β − 1
  double intercept_ns_ = 0.0;  // of r over p
  bool has_stamp_ = false;
  bool stamp_is_of_this_run_ = false;
  std::int64_t last_device_ns_ = 0;
  std::int64_t last_stamp_ns_ = 0;
};

}  // namespace asperity
