#include "simulated_icm42688.h"

#include <algorithm>
#include <cmath>

#include "fake_board.h"

namespace asperity {
namespace {

void put_row(void*, std::uint64_t n, std::int16_t* accel, std::int16_t* gyro) {
  const reference::Row row = fake_row(n);
  std::transform(row.accel.begin(), row.accel.end(), accel, [](int v) { return static_cast<std::int16_t>(v); });
  std::transform(row.gyro.begin(), row.gyro.end(), gyro, [](int v) { return static_cast<std::int16_t>(v); });
}

}  // namespace

SimulatedIcm42688::SimulatedIcm42688(double period_us) {
  asp_icm42688_model_init(&model_, static_cast<std::uint32_t>(std::lround(1e3 * period_us)), 5'000'000);
  model_.context = this;
  model_.row = put_row;
  model_.interrupt = [](void* self, std::uint64_t time_ns) {
    const auto& pulse = static_cast<SimulatedIcm42688*>(self)->on_interrupt;
    if (pulse) pulse(1e-3 * static_cast<double>(time_ns));
  };
  model_.byte_time = [](void* self) { static_cast<SimulatedIcm42688*>(self)->advance(1.0); };
  spi_ = {&model_,
          [](void* model, const std::uint8_t* out, std::uint8_t* in, std::size_t count) {
            return asp_icm42688_model_transfer(static_cast<asp_icm42688_model*>(model), out, in, count);
          },
          [](void* model, std::uint32_t us) {
            auto& self = *static_cast<asp_icm42688_model*>(model);
            asp_icm42688_model_advance_to(&self, self.now_ns + us * 1000u);
          }};
}

void SimulatedIcm42688::advance(double us) {
  asp_icm42688_model_advance_to(&model_, model_.now_ns + static_cast<std::uint64_t>(std::llround(1e3 * us)));
}

}  // namespace asperity
