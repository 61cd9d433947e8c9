#include "renderer.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "arrays.h"
#include "asperity/render/render_step.h"
#include "inputs.h"
#include "interruptible.h"
#include "parts.h"

namespace asperity::python {

namespace {

std::unique_ptr<const RenderModel> model_of(const std::shared_ptr<const Scene>& scene, const RenderConfig& config) {
  return interruptible([&](const Observer& observer) {
    return std::make_unique<const RenderModel>(make_render_model(*scene, config, observer));
  });
}

// The renderer's tip, or its scene and settings, are one thread's for as long as this lives.
class OneAtATime {
 public:
  OneAtATime(std::atomic<bool>& busy, const char* what) : busy_(busy) {
    if (busy_.exchange(true))
      throw std::runtime_error(std::string("the renderer ") + what + " already, in another thread or below a signal");
  }
  OneAtATime(const OneAtATime&) = delete;
  OneAtATime& operator=(const OneAtATime&) = delete;
  ~OneAtATime() { busy_ = false; }

 private:
  std::atomic<bool>& busy_;
};

// The arrays of many steps, one row a step.
class TouchArrays {
 public:
  explicit TouchArrays(std::size_t n)
      : force_(rows_of_three(n)),
        contact_(rows_of_three(n)),
        texture_(rows_of_three(n)),
        friction_(rows_of_three(n)),
        proxy_(rows_of_three(n)),
        point_(rows_of_three(n)),
        normal_(rows_of_three(n)),
        height_(column_of(n)),
        vibration_(column_of(n)),
        triangle_(column_of<std::uint32_t>(n)),
        object_(column_of<std::uint32_t>(n)),
        touching_(column_of<bool>(n)),
        sticking_(column_of<bool>(n)),
        inside_(column_of<bool>(n)),
        at_{rows(force_),
            rows(contact_),
            rows(texture_),
            rows(friction_),
            rows(proxy_),
            rows(point_),
            rows(normal_),
            height_.mutable_data(),
            vibration_.mutable_data(),
            triangle_.mutable_data(),
            object_.mutable_data(),
            touching_.mutable_data(),
            sticking_.mutable_data(),
            inside_.mutable_data()} {}

  void put(std::size_t i, const ServoOutput& out, double vibration_N) noexcept {
    at_.force[i] = out.force_N;
    at_.contact[i] = out.contact_N;
    at_.texture[i] = out.texture_N;
    at_.friction[i] = out.friction_N;
    at_.proxy[i] = out.proxy_m;
    at_.point[i] = out.contact.p_world_m;
    at_.normal[i] = out.contact.normal_world;
    at_.height[i] = out.texture_height_m;
    at_.vibration[i] = vibration_N;
    at_.triangle[i] = out.contact.triangle;
    at_.object[i] = out.contact.object;
    at_.touching[i] = out.contact.found();
    at_.sticking[i] = out.sticking;
    at_.inside[i] = out.starts_inside;
  }

  py::dict named() const {
    py::dict out;
    out["force_N"] = force_;
    out["contact_N"] = contact_;
    out["texture_N"] = texture_;
    out["friction_N"] = friction_;
    out["proxy_m"] = proxy_;
    out["point_m"] = point_;
    out["normal"] = normal_;
    out["texture_height_m"] = height_;
    out["vibration_N"] = vibration_;
    out["triangle"] = triangle_;
    out["object"] = object_;
    out["touching"] = touching_;
    out["sticking"] = sticking_;
    out["starts_inside"] = inside_;
    return out;
  }

 private:
  static Eigen::Vector3d* rows(py::array_t<double>& of) {
    return reinterpret_cast<Eigen::Vector3d*>(of.mutable_data());
  }

  struct At {
    Eigen::Vector3d *force, *contact, *texture, *friction, *proxy, *point, *normal;
    double *height, *vibration;
    std::uint32_t *triangle, *object;
    bool *touching, *sticking, *inside;
  };

  py::array_t<double> force_, contact_, texture_, friction_, proxy_, point_, normal_, height_, vibration_;
  py::array_t<std::uint32_t> triangle_, object_;
  py::array_t<bool> touching_, sticking_, inside_;
  At at_;
};

}  // namespace

Renderer::Renderer(const SharedScene& scene, double rate_Hz, const Settings& settings) : scene_(scene.of) {
  config_.texture.rate_Hz = within(rate_Hz, {100.0, 20000.0}, "rate_Hz");
  set_all(config_, settings.of);
  model_ = std::make_unique<SnapshotExchange<const RenderModel>>(model_of(scene_, config_));
}

double Renderer::interval_s(std::optional<double> dt_s) const {
  constexpr double kLongest_s = 3600.0;
  return dt_s ? within(*dt_s, {0.0, kLongest_s}, "dt_s") : 1.0 / rate_Hz();
}

template <class Use>
auto Renderer::advance(const Eigen::Vector3d& p_m, const Eigen::Vector3d* v_mps, double dt_s, const Use& use) noexcept {
  DeviceState device{p_m, Eigen::Vector3d::Zero(), dt_s};
  if (v_mps != nullptr) {
    device.v_world_mps = *v_mps;
  } else if (tip_.last_m && dt_s > 0.0) {
    device.v_world_mps = (p_m - *tip_.last_m) / dt_s;
  }
  tip_.last_m = p_m.allFinite() ? std::optional(p_m) : std::nullopt;
  constexpr double kLongest_s = 1.0;  // between two steps, for the vibration
  tip_.t_ns += static_cast<std::int64_t>(1e9 * std::min(dt_s, kLongest_s));
  const ServoOutput out = render_step(*model_->acquire(), tip_.state, device);
  return use(out, tip_.vibration.push(out.force_N, device.v_world_mps, tip_.t_ns));
}

Touch Renderer::step(py::handle position_m, const std::optional<py::object>& velocity_mps, std::optional<double> dt_s) {
  const Eigen::Vector3d p_m = vector_of(position_m, "position_m");
  const double interval = interval_s(dt_s);
  std::optional<Eigen::Vector3d> v_mps;
  if (velocity_mps) v_mps = vector_of(*velocity_mps, "velocity_mps");
  const OneAtATime alone(steps_, "steps");
  return advance(p_m, v_mps ? &*v_mps : nullptr, interval, [](const ServoOutput& output, double vibration_N) {
    return Touch{output, vibration_N};
  });
}

py::dict Renderer::steps(py::handle positions_m, const std::optional<py::object>& velocities_mps,
                         std::optional<double> dt_s) {
  const Rows p(positions_m, "positions_m");
  const double interval = interval_s(dt_s);
  std::optional<Rows> v;
  if (velocities_mps) {
    v.emplace(*velocities_mps, "velocities_mps");
    if (v->size() != p.size()) throw py::value_error("velocities_mps: as many as positions_m are wanted");
  }
  TouchArrays out(p.size());
  const OneAtATime alone(steps_, "steps");
  // A tip is large; a single block is not broken off.
  const auto before = p.size() > kBlock ? std::make_unique<Tip>(tip_) : nullptr;
  try {
    interruptible([&](const Observer& observer) {
      const Eigen::Vector3d* const velocity = v ? v->all().data() : nullptr;
      in_blocks(observer, p.size(), [&, at = p.all()](std::size_t i) {
        advance(at[i], velocity == nullptr ? nullptr : velocity + i, interval,
                [&](const ServoOutput& output, double vibration_N) { out.put(i, output, vibration_N); });
      });
    });
  } catch (...) {
    if (before) tip_ = *before;
    throw;
  }
  return out.named();
}

void Renderer::update(const std::optional<SharedScene>& scene, const Settings& settings) {
  const OneAtATime alone(updates_, "is updated");
  RenderConfig config = config_;
  set_all(config, settings.of);
  const std::shared_ptr<const Scene> of = scene ? scene->of : scene_;
  std::unique_ptr<const RenderModel> model = model_of(of, config);
  config_ = config;
  scene_ = of;
  model_->publish(std::move(model));
}

void Renderer::reset() {
  const OneAtATime alone(steps_, "steps");
  tip_ = Tip{};
}

}  // namespace asperity::python
