// asperity_feel of asperity_feel.h: the step and what is around it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "asperity/render/render_step.h"
#include "handles.h"
#include "status.h"

namespace {

using asperity::c_library::guarded;
using asperity::c_library::there;

// Of version 1.0; later ones are longer.
constexpr std::size_t kLeastMotion = offsetof(asperity_motion, dt_s) + sizeof(double);
constexpr std::size_t kLeastTouch = offsetof(asperity_touch, starts_inside) + sizeof(int);
constexpr std::size_t kMostBytes = std::size_t{1} << 16;

bool is_size(std::size_t size, std::size_t least) noexcept { return size >= least && size <= kMostBytes; }

std::unique_ptr<const asperity::RenderModel> model_of(const asperity_scene* scene, const asperity_settings* settings) {
  const asperity::RenderConfig config = settings == nullptr ? asperity::RenderConfig{} : settings->render;
  return std::make_unique<const asperity::RenderModel>(
      asperity::make_render_model(there(scene, "scene").scene, config));
}

void copy(const Eigen::Vector3d& from, double (&to)[3]) noexcept { Eigen::Vector3d::Map(to) = from; }

// All fields but the size.
void fill(const asperity::ServoOutput& output, double vibration_N, asperity_touch& out) noexcept {
  copy(output.force_N, out.force_N);
  copy(output.contact_N, out.contact_N);
  copy(output.texture_N, out.texture_N);
  copy(output.friction_N, out.friction_N);
  copy(output.proxy_m, out.proxy_m);
  out.texture_height_m = output.texture_height_m;
  out.vibration_N = vibration_N;
  out.touching = output.contact.found() ? 1 : 0;
  copy(output.contact.p_world_m, out.point_m);
  copy(output.contact.normal_world, out.normal);
  copy(output.contact.barycentric, out.barycentric);
  out.object = output.contact.object;
  out.triangle = output.contact.triangle;
  out.sticking = output.sticking ? 1 : 0;
  out.starts_inside = output.starts_inside ? 1 : 0;
}

// `motion` and `touch` may be of another version's size.
void step(asperity_feel& feel, const asperity::RenderModel& model, const std::byte* motion, std::byte* touch,
          std::size_t touch_bytes) noexcept {
  asperity_motion in;
  std::memcpy(&in, motion, kLeastMotion);
  asperity::DeviceState device;
  device.p_world_m = Eigen::Vector3d::Map(in.position_m);
  device.v_world_mps = Eigen::Vector3d::Map(in.velocity_mps);
  device.dt_s = in.dt_s;
  const asperity::ServoOutput output = asperity::render_step(model, feel.state, device);
  constexpr double kLongest_s = 1.0;  // between two steps
  if (in.dt_s > 0.0) feel.t_ns += static_cast<std::int64_t>(1e9 * std::min(in.dt_s, kLongest_s));
  const double vibration_N = feel.vibration.push(output.force_N, device.v_world_mps, feel.t_ns);
  // In place where it can be: a copy would cost as much as all else around the step.
  const bool in_place = touch_bytes >= sizeof(asperity_touch) && touch_bytes % alignof(asperity_touch) == 0;
  asperity_touch other;
  asperity_touch& out = in_place ? *reinterpret_cast<asperity_touch*>(touch) : other;
  out.size = touch_bytes;
  fill(output, vibration_N, out);
  if (!in_place) std::memcpy(touch, &other, std::min(touch_bytes, sizeof other));
}

}  // namespace

extern "C" {

asperity_status asperity_feel_create(const asperity_scene* scene, const asperity_settings* settings,
                                     asperity_feel** feel) {
  if (feel != nullptr) *feel = nullptr;
  return guarded([&] {
    asperity_feel*& out = there(feel, "feel");
    out = new asperity_feel(model_of(scene, settings));
  });
}

void asperity_feel_free(asperity_feel* feel) { delete feel; }

asperity_status asperity_feel_update(asperity_feel* feel, const asperity_scene* scene,
                                     const asperity_settings* settings) {
  return guarded([&] {
    asperity_feel& of = there(feel, "feel");
    of.model.publish(model_of(scene, settings));
  });
}

void asperity_motion_init(asperity_motion* motion, size_t size) {
  if (motion == nullptr || !is_size(size, kLeastMotion)) return;
  std::memset(static_cast<void*>(motion), 0, size);
  motion->size = size;
}

void asperity_touch_init(asperity_touch* touch, size_t size) {
  if (touch == nullptr || !is_size(size, kLeastTouch)) return;
  std::memset(static_cast<void*>(touch), 0, size);
  touch->size = size;
}

asperity_status asperity_feel_step(asperity_feel* feel, const asperity_motion* motion, asperity_touch* touch) {
  return asperity_feel_steps(feel, motion, touch, 1);
}

asperity_status asperity_feel_steps(asperity_feel* feel, const asperity_motion* motions, asperity_touch* touches,
                                    size_t count) {
  if (feel == nullptr || (count > 0 && (motions == nullptr || touches == nullptr))) return ASPERITY_BAD_ARGUMENT;
  if (count == 0) return ASPERITY_OK;
  const std::size_t motion_bytes = motions->size, touch_bytes = touches->size;
  if (!is_size(motion_bytes, kLeastMotion) || !is_size(touch_bytes, kLeastTouch)) return ASPERITY_BAD_ARGUMENT;
  const auto* motion = reinterpret_cast<const std::byte*>(motions);
  auto* touch = reinterpret_cast<std::byte*>(touches);
  for (std::size_t i = 0; i < count; ++i, motion += motion_bytes, touch += touch_bytes)
    step(*feel, *feel->model.acquire(), motion, touch, touch_bytes);
  return ASPERITY_OK;
}

void asperity_feel_reset(asperity_feel* feel) {
  if (feel == nullptr) return;
  feel->state = asperity::ServoState{};
  feel->vibration = asperity::VibrationAxis{};
  feel->t_ns = 0;
}
}
