#include "move_proxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "convex_step.h"
#include "escape_local_minimum.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

constexpr int kMostIterations = 48;
constexpr int kMostEscapes = 8;
// A ball that falls off a ridge would fly over the next valleys if it were let go all the way to its goal at once; of
// so many strides of the hand it cannot miss much.
constexpr double kLeap = 1.5;
constexpr double kLeapGrowth = 1.125;  // so that it gets there
constexpr double kPointLike = 16.0;    // of a radius in skins: below, the skin is what the ball is made of

// What one call may cost, in evaluations of triangles of some nanoseconds each. Every iteration is safe: what is not
// reached in this step of the servo is in the next.
constexpr std::int64_t kMostWork = 1 << 17;
constexpr std::int64_t kQueryWork = 64;                        // of a search in one object's tree
constexpr std::int64_t kMetPerTry = 2 * NearTriangles::kMost;  // of a gathering in vain

constexpr double kFarther = 8.0;  // than before
constexpr int kMostTries = 3;     // to gather
constexpr std::uint32_t kCrowd = 32;
constexpr int kPatience = 24;   // iterations among a crowd
constexpr int kMostAdded = 64;  // triangles to an incomplete list in one call

// Looking far costs triangles at each step, looking near costs a search more often: the list is to last for some steps
// of the hand unless it gets long, and need not be kept short where it is.
constexpr double kStrides = 1.5;
constexpr std::uint32_t kManyTriangles = 8;
constexpr std::uint32_t kFewTriangles = 4;

// Leaves in the list no triangles but those that the proxy touches.
void keep_touched(const RenderModel& model, ObjectSet objects, ProxyState& proxy) {
  proxy.near.complete = false;
  proxy.near.count = 0;
  if (proxy.over_texture) return;
  for (std::uint32_t k = 0; k < proxy.touch_count; ++k)
    if (objects >> proxy.touches[k].object & 1u)
      add_triangle(model, proxy.touches[k].object, proxy.touches[k].triangle, proxy.near);
}

// Gathers round the proxy, at least `wanted_m` beyond its ball if that is not too many triangles and not much farther
// than it was worth before: so a goal far away costs no more in one step than one that is near. Where too many
// triangles meet, the list keeps those that are touched; move_proxy() adds what it meets.
void gather_around(const RenderModel& model, const ProxyBall& ball, double wanted_m, ObjectSet objects,
                   ProxyState& proxy) {
  const double least_m = 0x1p-10 * ball.coarse_m;
  if (!(proxy.reach_m > 0.0)) proxy.reach_m = ball.coarse_m;
  double reach_m = std::max(proxy.reach_m, std::min(wanted_m, kFarther * proxy.reach_m));
  const double enough_m = std::max(kStrides * ball.stride_m, least_m);
  for (int tries = 0; !gather_triangles(model, proxy.p_world_m, ball.radius_m + reach_m, objects, proxy.near);
       ++tries) {
    proxy.work += kMetPerTry;
    if (tries == kMostTries) {
      proxy.near.radius_m = ball.radius_m + std::max(reach_m, std::min(enough_m, proxy.reach_m));
      keep_touched(model, objects, proxy);
      return;
    }
    reach_m *= 0.25;
  }
  proxy.work += 4 * std::int64_t{proxy.near.count};
  proxy.reach_m = std::max(std::min(proxy.reach_m, reach_m), least_m);
  if (proxy.near.count > kManyTriangles) proxy.reach_m = std::min(proxy.reach_m, std::max(0.5 * reach_m, enough_m));
  if (proxy.near.count < kFewTriangles) proxy.reach_m = std::min(2.0 * reach_m, 64.0 * ball.coarse_m);
}

// How far the proxy may go from where it is before the list may lack a triangle.
double room_m(const ProxyState& proxy, double radius_m) {
  return proxy.near.radius_m - radius_m - (proxy.p_world_m - proxy.near.centre_m).norm();
}

// A triangle that bars the straight way to `to_m`: crossed by the centre's way, or too near to its end or its middle.
// Of a way that is long beside the ball the triangles that the ball would only brush are not all found.
bool find_barrier(const RenderModel& model, const ProxyBall& ball, ObjectSet objects, const Vector3d& from_m,
                  const Vector3d& to_m, std::uint32_t& barrier_object, std::uint32_t& barrier) {
  const double free_m = ball.radius_m - 2.0 * ball.slack_m;
  for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
    if (!(objects >> o & 1u)) continue;
    const RenderObject& object = model.objects[o];
    const Pose T_mesh_world = object.T_world_mesh.inverse();
    const Vector3d a_m = T_mesh_world * from_m, b_m = T_mesh_world * to_m;
    barrier_object = o;
    barrier = object.bvh.cast_ray(a_m, b_m - a_m, 1.0).triangle;
    if (barrier == ClosestPoint::kNone) barrier = object.bvh.closest_point(b_m, free_m).triangle;
    if (barrier == ClosestPoint::kNone) barrier = object.bvh.closest_point(0.5 * (a_m + b_m), free_m).triangle;
    if (barrier != ClosestPoint::kNone) return true;
  }
  return false;
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

void ensure_triangles_within(const RenderModel& model, const ProxyBall& ball, double distance_m, ObjectSet objects,
                             ProxyState& proxy) noexcept {
  if (room_m(proxy, distance_m) >= 0.0) return;
  gather_around(model, ball, 2.0 * std::max(distance_m - ball.radius_m, 0.0), objects, proxy);
}

bool move_proxy(const RenderModel& model, const ProxyBall& ball, const Vector3d& goal_m, ObjectSet objects,
                ProxyState& proxy) noexcept {
  double wanted_m = ball.stride_m;
  const bool may_escape = ball.radius_m <= kPointLike * ball.skin_m;
  double leap_m = std::max(kLeap * ball.stride_m, 0x1p-4 * ball.coarse_m);
  int escapes = 0;
  int added = 0;
  const std::int64_t most_work = proxy.work + kMostWork;
  for (int iteration = 0; iteration < kMostIterations && proxy.work < most_work; ++iteration) {
    const double left_m = (goal_m - proxy.p_world_m).norm();
    double reach_m = room_m(proxy, ball.radius_m);
    if (!(reach_m > 0.0)) {
      gather_around(model, ball, std::min(wanted_m, left_m), objects, proxy);
      wanted_m *= 4.0;  // it goes farther than the hand did
      reach_m = room_m(proxy, ball.radius_m);
    }
    std::array<std::uint32_t, 3> touched{};
    const std::size_t touched_count = find_touched(proxy, touched);
    const ConvexStep step = convex_step(std::span(proxy.near.triangles.data(), proxy.near.count),
                                        {proxy.p_world_m, ball.radius_m, ball.slack_m}, goal_m,
                                        std::span(touched.data(), touched_count), most_work - proxy.work);
    proxy.work += step.work;
    if (proxy.near.complete && proxy.near.count > kCrowd && (step.failed || iteration == kPatience)) {
      // Very many planes that differ by little: those that matter are found one by one.
      keep_touched(model, objects, proxy);
      continue;
    }
    note_touches(step, proxy);
    const Vector3d way_m = step.centre_m - proxy.p_world_m;
    const double length_m = way_m.norm();
    // Not farther than the triangles are known, nor than it can be said to follow the surface.
    const double most_m = std::min(reach_m, leap_m);
    double part = length_m > most_m ? most_m / length_m : 1.0;
    if (!proxy.near.complete) {
      std::uint32_t object = 0, triangle = 0;
      const auto is_barred = [&] {
        proxy.work += kQueryWork * static_cast<std::int64_t>(model.objects.size());
        return find_barrier(model, ball, objects, proxy.p_world_m, proxy.p_world_m + part * way_m, object, triangle);
      };
      if (is_barred()) {
        if (added < kMostAdded && add_triangle(model, object, triangle, proxy.near)) {
          ++added;
          --iteration;
          continue;
        }
        do {
          part *= 0.25;
          if (part < 0x1p-10) return false;
        } while (is_barred());
      }
    }
    leap_m *= kLeapGrowth;
    if (part < 1.0) {
      proxy.p_world_m += part * way_m;
      if (most_m >= reach_m) proxy.near.radius_m = -1.0;
      continue;
    }
    proxy.p_world_m = step.centre_m;
    if (!step.exact && length_m > 0x1p-40 * left_m) continue;
    if (!may_escape || escapes == kMostEscapes || !proxy.near.complete || proxy.touch_count < 2) return true;
    ++escapes;
    std::int64_t work = most_work - proxy.work;
    const bool escaped = escape_local_minimum(proxy, ball, goal_m, work);
    proxy.work = most_work - work;
    if (!escaped) return true;
  }
  return false;
}

}  // namespace asperity
