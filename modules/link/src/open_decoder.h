#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "asperity/link/device_clock.h"
#include "asperity/link/open_protocol.h"
#include "asperity/link/probe_decoder.h"

namespace asperity {

// Reads the open probe's frames (docs/probe-protocol.md).
class OpenDecoder : public ProbeDecoder {
 public:
  void push(std::span<const std::uint8_t> bytes, std::int64_t arrival_ns, std::vector<ProbeSample>& out) override;
  const LinkStatistics& statistics() const override { return statistics_; }
  std::optional<ProbeDescription> description() const override { return description_; }

 private:
  // What tells a start frame that came twice from a second start.
  struct StartMark {
    std::uint32_t sequence = 0;
    std::uint32_t imu_index = 0;
    std::uint64_t time_us = 0;
    bool operator==(const StartMark&) const = default;
  };
  // A force sample that no row has taken yet.
  struct Force {
    std::int64_t device_ns = 0;
    std::array<std::int32_t, 3> counts{};
    bool is_force3 = false;
  };

  void take_block(std::span<const std::uint8_t> block, std::int64_t arrival_ns, std::vector<ProbeSample>& out);
  bool take_samples(std::span<const std::uint8_t> payload, std::int64_t arrival_ns, std::vector<ProbeSample>& out);
  bool is_wanted(std::int64_t arrival_ns);
  bool goes_on() const;
  void begin_count(bool restarted);
  void count_losses();
  void give_rows(std::int64_t time_ns, std::vector<ProbeSample>& out);
  void lay_forces(std::int64_t time_ns, std::span<ProbeSample> rows);

  LinkStatistics statistics_;
  std::optional<ProbeDescription> description_;
  std::vector<std::uint8_t> block_;  // the beginning of one whose end has not come
  bool block_too_long_ = false;
  bool in_damage_ = false;
  OpenPayload payload_{};
  OpenSamples samples_;
  DeviceClock clock_;

  bool counting_ = false;
  std::optional<StartMark> start_;
  std::uint32_t newest_sequence_ = 0;
  std::uint32_t next_imu_index_ = 0;
  // Of the newest frame with rows, if there was one.
  bool newest_has_rows_ = false;
  std::uint32_t newest_imu_index_ = 0;
  std::uint64_t newest_time_us_ = 0;
  double row_period_ns_ = 0.0;
  std::uint64_t origin_us_ = 0;  // of the device times
  std::uint32_t late_run_ = 0;   // late frames since the last accepted one, each following the one before
  std::uint32_t late_sequence_ = 0;
  std::uint64_t late_time_us_ = 0;
  std::int64_t late_since_ns_ = 0;
  std::vector<Force> forces_;
  std::vector<int> force_counts_;
};

}  // namespace asperity
