#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

#include "asperity/device/servo_tick.h"
#include "asperity/study/tile_touch.h"

namespace asperity {

// How the tiles of one trial were touched, from the ticks of the runs in which it was rendered. Thread-safe.
class TileTouches {
 public:
  // `tile_of_triangle` has 0 or 1 for each triangle of the scene's only object, -1 for those of no tile.
  TileTouches(std::vector<int> tile_of_triangle, double least_force_N);

  // Ticks of a run in order.
  void add(const ServoTick& tick);
  std::array<TileTouch, 2> touches() const;

 private:
  struct Sum {
    double touch_s = 0.0;
    double impulse_Ns = 0.0;
  };

  const std::vector<int> tile_of_triangle_;
  const double least_force_N_;
  mutable std::mutex mutex_;
  std::array<Sum, 2> sums_;
  std::int64_t before_ns_ = -1;  // the tick before; -1: none
};

}  // namespace asperity
