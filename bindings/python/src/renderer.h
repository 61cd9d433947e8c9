#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include <pybind11/pybind11.h>
#include <Eigen/Core>

#include "asperity/device/snapshot_exchange.h"
#include "asperity/device/vibration_axis.h"
#include "asperity/render/render_model.h"
#include "asperity/render/servo_output.h"
#include "asperity/render/servo_state.h"
#include "named_arguments.h"
#include "shared_scene.h"

namespace asperity::python {

namespace py = pybind11;

// What a step gives: the renderer's output, and the part of its force that vibrates.
struct Touch {
  ServoOutput out;
  double vibration_N = 0.0;
};

// One tip over a scene. One thread steps at a time; any other may update().
class Renderer {
 public:
  Renderer(const SharedScene& scene, double rate_Hz, const Settings& settings);

  // To a position, by a velocity or that from the last position. Throws RuntimeError while it steps elsewhere.
  Touch step(py::handle position_m, const std::optional<py::object>& velocity_mps, std::optional<double> dt_s);
  // Many, one after the other. What is broken off leaves the tip where it was before.
  py::dict steps(py::handle positions_m, const std::optional<py::object>& velocities_mps, std::optional<double> dt_s);
  // Another scene, or settings, from the next step on.
  void update(const std::optional<SharedScene>& scene, const Settings& settings);
  void reset();

  double rate_Hz() const { return config_.texture.rate_Hz; }

 private:
  // All that the tip remembers between two steps.
  struct Tip {
    ServoState state;
    VibrationAxis vibration;
    std::int64_t t_ns = 0;
    std::optional<Eigen::Vector3d> last_m;
  };

  // Passes the step's output and vibration to `use`, in place.
  template <class Use>
  auto advance(const Eigen::Vector3d& p_m, const Eigen::Vector3d* v_mps, double dt_s, const Use& use) noexcept;
  double interval_s(std::optional<double> dt_s) const;

  std::shared_ptr<const Scene> scene_;
  RenderConfig config_;
  std::unique_ptr<SnapshotExchange<const RenderModel>> model_;
  Tip tip_;
  std::atomic<bool> steps_ = false, updates_ = false;
};

}  // namespace asperity::python
