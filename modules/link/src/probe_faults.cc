#include "asperity/link/probe_faults.h"

#include <array>
#include <string_view>

#include <fmt/format.h>

namespace asperity {

namespace {

constexpr std::array<std::string_view, 6> kStates = {
    "works", "its bus fails", "not found", "it does not reset", "a register does not keep its value", "no samples"};

class Parts {
 public:
  void add_state(std::uint8_t state) {
    if (state == 0) return;
    add(state < kStates.size() ? std::string(kStates[state]) : fmt::format("state {}", state));
  }
  void add_count(std::uint32_t count, std::string_view one, std::string_view many) {
    if (count > 0) add(fmt::format("{} {}", count, count == 1 ? one : many));
  }
  std::string of(std::string_view sensor) const { return text_.empty() ? "" : fmt::format("{}: {}", sensor, text_); }

 private:
  void add(const std::string& part) { text_ += (text_.empty() ? "" : ", ") + part; }
  std::string text_;
};

}  // namespace

std::string describe_faults(const ProbeFaults& f) {
  Parts imu;
  imu.add_state(f.imu_state);
  imu.add_count(f.imu_bus_failures, "bus failure", "bus failures");
  imu.add_count(f.imu_overflows, "overflow", "overflows");
  imu.add_count(f.imu_lost_sync, "read out of step", "reads out of step");
  imu.add_count(f.imu_invalid_rows, "invalid row", "invalid rows");
  imu.add_count(f.imu_restarts, "restart", "restarts");
  Parts force;
  force.add_state(f.force_state);
  force.add_count(f.force_bus_failures, "bus failure", "bus failures");
  force.add_count(f.force_skipped, "conversion skipped", "conversions skipped");
  force.add_count(f.force_restarts, "restart", "restarts");
  const std::string first = imu.of("inertial sensor");
  const std::string second = force.of("force sensor");
  return first + (first.empty() || second.empty() ? "" : "; ") + second;
}

}  // namespace asperity
