#include "follow_moving_objects.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

bool is_same_pose(const Pose& a, const Pose& b) {
  return a.rotation.coeffs() == b.rotation.coeffs() && a.translation_m == b.translation_m;
}

// Goes to a place without a change of what is touched, and with the list of triangles left empty.
void sweep_objects(const RenderModel& model, const ProxyBall& ball, const Vector3d& goal_m, ObjectSet objects,
                   ProxyState& proxy) {
  const auto touches = proxy.touches;
  const std::uint32_t count = proxy.touch_count;
  const bool over_texture = proxy.over_texture;
  proxy.touch_count = 0;
  proxy.near.radius_m = -1.0;
  move_proxy(model, ball, goal_m, objects, proxy);
  proxy.near.radius_m = -1.0;
  proxy.touches = touches;
  proxy.touch_count = count;
  proxy.over_texture = over_texture;
}

}  // namespace

void follow_moving_objects(const RenderModel& model, const ProxyBall& ball, ProxyState& proxy) noexcept {
  ObjectSet moving = 0, all = 0;
  for (std::size_t o = 0; o < model.objects.size(); ++o) {
    all |= ObjectSet{1} << o;
    if (!is_same_pose(model.objects[o].T_world_mesh, proxy.T_world_mesh[o])) moving |= ObjectSet{1} << o;
  }
  if (moving == 0) return;
  ObjectSet in_place = all & ~moving;
  for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
    const ObjectSet self = ObjectSet{1} << o;
    if (!(moving & self)) continue;
    const Pose& T_new = model.objects[o].T_world_mesh;
    const Pose motion = T_new * proxy.T_world_mesh[o].inverse();
    proxy.T_world_mesh[o] = T_new;
    bool touched = false;
    for (std::uint32_t k = 0; k < proxy.touch_count; ++k) {
      if (proxy.touches[k].object != o) continue;
      proxy.touches[k].normal_world = motion.rotation * proxy.touches[k].normal_world;
      touched = true;
    }
    const Vector3d before_m = proxy.p_world_m;
    proxy.p_world_m = motion * before_m;
    if (!touched) sweep_objects(model, ball, before_m, self, proxy);
    const Vector3d pushed_m = proxy.p_world_m;
    proxy.p_world_m = before_m;
    if ((pushed_m - before_m).norm() > ball.slack_m) {
      if (in_place != 0)
        sweep_objects(model, ball, pushed_m, in_place, proxy);
      else
        proxy.p_world_m = pushed_m;
    }
    in_place |= self;
  }
  proxy.near.radius_m = -1.0;
}

}  // namespace asperity
