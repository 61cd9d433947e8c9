#include "move_proxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "convex_step.h"
#include "hop_over_nook.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr int kMostIterations = 48;
constexpr int kMostHops = 8;
// A ball that falls off a ridge would fly over the next valleys if it were let go all the way to its goal at once; of
// so many strides of the hand it cannot miss much.
constexpr double kLeap = 1.5;
constexpr double kLeapGrowth = 1.125;  // so that it gets there
constexpr double kPointLike = 16.0;    // of a radius in skins: below, the skin is what the ball is made of

// Looking far costs triangles at each step, looking near costs a search more often: the list is to last for some steps
// of the hand unless it gets long, and need not be kept short where it is.
constexpr double kStrides = 1.5;
constexpr std::uint32_t kManyTriangles = 8;
constexpr std::uint32_t kFewTriangles = 4;

// Gathers round the proxy, at least `wanted_m` beyond its ball if that is not too many triangles.
void gather_around(const RenderModel& model, const ProxyBall& ball, double wanted_m, ObjectSet objects,
                   ProxyState& proxy) {
  const double least_m = 0x1p-10 * ball.coarse_m;
  if (!(proxy.reach_m > 0.0)) proxy.reach_m = ball.coarse_m;
  double reach_m = std::max(proxy.reach_m, wanted_m);
  while (!gather(model, proxy.p_world_m, ball.radius_m + reach_m, objects, proxy.near) && reach_m > least_m)
    reach_m *= 0.5;
  const double enough_m = std::max(kStrides * ball.stride_m, least_m);
  proxy.reach_m = std::min(proxy.reach_m, reach_m);
  if (proxy.near.count > kManyTriangles) proxy.reach_m = std::min(proxy.reach_m, std::max(0.5 * reach_m, enough_m));
  if (proxy.near.count < kFewTriangles) proxy.reach_m = std::min(2.0 * reach_m, 64.0 * ball.coarse_m);
}

// How far the proxy may go from where it is before the list may lack a triangle.
double room_m(const ProxyState& proxy, double radius_m) {
  return proxy.near.radius_m - radius_m - (proxy.p_world_m - proxy.near.centre_m).norm();
}

bool is_free(const RenderModel& model, const ProxyBall& ball, ObjectSet objects, const Vector3d& p_m) {
  for (std::size_t o = 0; o < model.objects.size(); ++o) {
    if (!(objects >> o & 1u)) continue;
    const RenderObject& object = model.objects[o];
    const ClosestPoint closest =
        object.bvh.closest_point(object.T_world_mesh.inverse() * p_m, ball.radius_m - 2.0 * ball.slack_m);
    if (closest.found()) return false;
  }
  return true;
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
  for (std::uint32_t k = 1; k < proxy.touch_count; ++k)
    for (std::uint32_t i = k; i > 0 && proxy.touches[i - 1].pull_m < proxy.touches[i].pull_m; --i)
      std::swap(proxy.touches[i - 1], proxy.touches[i]);
}

}  // namespace

void look_around(const RenderModel& model, const ProxyBall& ball, double distance_m, ObjectSet objects,
                 ProxyState& proxy) noexcept {
  if (room_m(proxy, distance_m) >= 0.0) return;
  gather_around(model, ball, 2.0 * std::max(distance_m - ball.radius_m, 0.0), objects, proxy);
}

bool move_proxy(const RenderModel& model, const ProxyBall& ball, const Vector3d& goal_m, ObjectSet objects,
                ProxyState& proxy) noexcept {
  double wanted_m = ball.stride_m;
  const bool may_hop = ball.radius_m <= kPointLike * ball.skin_m;
  double leap_m = std::max(kLeap * ball.stride_m, 0x1p-4 * ball.coarse_m);
  int hops = 0;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const double left_m = (goal_m - proxy.p_world_m).norm();
    double reach_m = room_m(proxy, ball.radius_m);
    if (!(reach_m > 0.0)) {
      gather_around(model, ball, std::min(wanted_m, left_m), objects, proxy);
      wanted_m *= 4.0;  // it goes farther than the hand did
      reach_m = room_m(proxy, ball.radius_m);
    }
    std::array<std::uint32_t, 3> touched{};
    const std::size_t touched_count = find_touched(proxy, touched);
    const ConvexStep step =
        convex_step(std::span(proxy.near.triangles.data(), proxy.near.count),
                    {proxy.p_world_m, ball.radius_m, ball.slack_m}, goal_m, std::span(touched.data(), touched_count));
    note_touches(step, proxy);
    const Vector3d way_m = step.centre_m - proxy.p_world_m;
    const double length_m = way_m.norm();
    // Not farther than the triangles are known, nor than it can be said to follow the surface.
    const double most_m = std::min(reach_m, leap_m);
    leap_m *= kLeapGrowth;
    double part = length_m > most_m ? most_m / length_m : 1.0;
    if (!proxy.near.complete) {
      // Too many triangles for the list: the end of the way is checked against all of them, the way itself is not.
      while (part > 0x1p-10 && !is_free(model, ball, objects, proxy.p_world_m + part * way_m)) part *= 0.5;
      if (!(part > 0x1p-10)) return false;
    }
    if (part < 1.0) {
      proxy.p_world_m += part * way_m;
      if (most_m >= reach_m) proxy.near.radius_m = -1.0;
      continue;
    }
    proxy.p_world_m = step.centre_m;
    if (!step.exact && length_m > 0x1p-40 * left_m) continue;
    if (!may_hop || hops == kMostHops || proxy.touch_count < 2) return true;
    ++hops;
    if (!hop_over_nook(proxy, ball, goal_m)) return true;
  }
  return false;
}

}  // namespace asperity
