#include "asperity/session/tile_touches.h"

#include <utility>

namespace asperity {

namespace {

// Ticks that were skipped count up to here; a longer gap is one between two runs.
constexpr double kLongestTick_s = 0.05;

}  // namespace

TileTouches::TileTouches(std::vector<int> tile_of_triangle, double least_force_N)
    : tile_of_triangle_(std::move(tile_of_triangle)), least_force_N_(least_force_N) {}

void TileTouches::add(const ServoTick& tick) {
  const std::lock_guard guard(mutex_);
  const double dt_s = 1e-9 * static_cast<double>(tick.t_ns - before_ns_);
  const bool follows = before_ns_ >= 0 && dt_s > 0.0 && dt_s <= kLongestTick_s;
  before_ns_ = tick.t_ns;
  const SurfaceContact& contact = tick.output.contact;
  const double force_N = tick.out_world_N.norm();
  if (!follows || !contact.found() || contact.triangle >= tile_of_triangle_.size()) return;
  if (!(force_N > 0.0 && force_N >= least_force_N_)) return;
  const int tile = tile_of_triangle_[contact.triangle];
  if (tile < 0) return;
  Sum& sum = sums_.at(static_cast<std::size_t>(tile));
  sum.touch_s += dt_s;
  sum.impulse_Ns += force_N * dt_s;
}

std::array<TileTouch, 2> TileTouches::touches() const {
  const std::lock_guard guard(mutex_);
  std::array<TileTouch, 2> out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Sum& sum = sums_[k];
    if (sum.touch_s > 0.0) out[k] = {sum.touch_s, sum.impulse_Ns / sum.touch_s};
  }
  return out;
}

}  // namespace asperity
