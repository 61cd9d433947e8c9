#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/device/safety_cause.h"
#include "asperity/device/servo_loop.h"
#include "asperity/device/servo_tick.h"
#include "asperity/fidelity/renderer_check.h"
#include "asperity/json/json.h"

namespace asperity {

// What a run was like, summed tick by tick.
class FeelStatistics {
 public:
  void add(const ServoTick& tick);

  std::size_t ticks() const { return ticks_; }
  std::size_t touching() const { return touching_; }
  std::size_t starting_inside() const { return starting_inside_; }
  std::size_t caused(SafetyCause cause) const;
  Json json() const;
  // Two lines for a person.
  std::string text() const;

 private:
  std::size_t ticks_ = 0, touching_ = 0, sticking_ = 0, starting_inside_ = 0;
  std::array<std::size_t, kSafetyCauseNames.size()> causes_{};
  double peak_N_ = 0.0, square_N2_ = 0.0, peak_out_N_ = 0.0, square_out_N2_ = 0.0;
  double peak_contact_N_ = 0.0, peak_texture_N_ = 0.0, peak_friction_N_ = 0.0;
  double lowest_m_ = std::numeric_limits<double>::infinity();
  double highest_m_ = -std::numeric_limits<double>::infinity();
};

Json renderer_check_json(const RendererCheck& score);
std::string renderer_check_text(const RendererCheck& score);

// Schedule and durations, in microseconds.
Json timing_json(const ServoStatistics& statistics, const ServoConfig& config);
std::string timing_text(const ServoStatistics& statistics, const ServoConfig& config);

}  // namespace asperity
