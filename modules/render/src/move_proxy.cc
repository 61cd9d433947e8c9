#include "move_proxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "convex_step.h"
#include "gather.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr int kMostIterations = 32;
constexpr std::uint32_t kManyTriangles = 48;  // more are looked at only where the step needs them
constexpr std::uint32_t kFewTriangles = 6;

// Gathers round the proxy, as far as `wanted_m` beyond its ball if that is not too many triangles.
void look_around(const RenderModel& model, const ProxyBall& ball, double wanted_m, std::uint32_t only,
                 ProxyState& proxy) {
  double reach_m = proxy.reach_m > 0.0 ? std::max(proxy.reach_m, wanted_m) : ball.coarse_m;
  for (int halving = 0; halving < 40; ++halving) {
    if (gather(model, proxy.p_world_m, ball.radius_m + reach_m, only, proxy.near)) break;
    reach_m *= 0.5;
  }
  proxy.reach_m = reach_m;
  if (proxy.near.count > kManyTriangles && reach_m > wanted_m) proxy.reach_m = std::max(0.5 * reach_m, wanted_m);
  if (proxy.near.count < kFewTriangles) proxy.reach_m = std::min(2.0 * reach_m, 64.0 * ball.coarse_m);
}

// The places in the list of the triangles that the proxy touches.
std::size_t find_touched(const ProxyState& proxy, std::array<std::uint32_t, 3>& places) {
  std::size_t count = 0;
  if (proxy.over_texture) return 0;
  for (std::uint32_t k = 0; k < proxy.touch_count; ++k) {
    const ProxyTouch& touch = proxy.touches[k];
    for (std::uint32_t i = 0; i < proxy.near.count; ++i) {
      if (proxy.near.triangles[i].triangle != touch.triangle || proxy.near.triangles[i].object != touch.object)
        continue;
      places[count++] = i;
      break;
    }
  }
  return count;
}

void note_touches(const ConvexStep& step, ProxyState& proxy) {
  proxy.over_texture = false;
  proxy.touch_count = static_cast<std::uint32_t>(step.touch_count);
  for (std::uint32_t k = 0; k < proxy.touch_count; ++k) {
    const ConvexStep::Touch& from = step.touches[k];
    const NearTriangle& t = proxy.near.triangles[from.index];
    proxy.touches[k] = {t.object, t.triangle, from.barycentric, from.normal, from.pull_m};
  }
  std::stable_sort(proxy.touches.begin(), proxy.touches.begin() + proxy.touch_count,
                   [](const ProxyTouch& a, const ProxyTouch& b) { return a.pull_m > b.pull_m; });
}

}  // namespace

bool move_proxy(const RenderModel& model, const ProxyBall& ball, const Vector3d& goal_m, std::uint32_t only,
                ProxyState& proxy) noexcept {
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const double left_m = (goal_m - proxy.p_world_m).norm();
    // The list says nothing of what is farther from its centre than its radius.
    const auto room = [&] {
      return proxy.near.radius_m - ball.radius_m - (proxy.p_world_m - proxy.near.centre_m).norm();
    };
    double room_m = room();
    if (!(room_m > 0.0)) {
      look_around(model, ball, std::min(0.25 * left_m, ball.coarse_m), only, proxy);
      room_m = room();
    }

    std::array<std::uint32_t, 3> touched{};
    const std::size_t touched_count = find_touched(proxy, touched);
    const ConvexStep step =
        convex_step(std::span(proxy.near.triangles.data(), proxy.near.count),
                    {proxy.p_world_m, ball.radius_m, ball.slack_m}, goal_m, std::span(touched.data(), touched_count));
    const Vector3d way_m = step.centre_m - proxy.p_world_m;
    const double length_m = way_m.norm();
    note_touches(step, proxy);
    if (length_m > room_m) {
      proxy.p_world_m += (room_m / length_m) * way_m;
      proxy.near.radius_m = -1.0;
      continue;
    }
    proxy.p_world_m = step.centre_m;
    if (step.exact || length_m <= 0x1p-40 * left_m) return true;
  }
  return false;
}

}  // namespace asperity
