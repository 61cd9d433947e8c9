#include "probe_rig.h"

#include <gmock/gmock.h>

namespace asperity {

asp_description description_of(bool gyro, bool force3) {
  return {"test probe", "1.0.0", 4000, -32768, 32767, 208.848, gyro, 939.65, force3 ? 3 : 1, 1000, 1.2e-06};
}

ProbeRig::ProbeRig(const FakeBoard::Options& options, bool gyro, bool force3, const asp_probe_config& config)
    : board(options), probe(std::make_unique<asp_probe>()) {
  const asp_description description = description_of(gyro, force3);
  EXPECT_TRUE(asp_probe_init(probe.get(), board.board(), &description, &config));
}

void ProbeRig::run_us(std::uint64_t us, std::uint64_t step_us) {
  for (std::uint64_t done = 0; done < us; done += step_us) {
    board.advance(step_us);
    asp_probe_step(probe.get());
  }
}

Account check_samples(const ProbeRig& rig, const std::vector<reference::SampleFrame>& frames,
                      std::uint32_t first_sequence, std::uint32_t first_index, double time_tol_ns) {
  Account account;
  std::uint32_t sequence = first_sequence;
  for (const reference::SampleFrame& frame : frames) {
    EXPECT_EQ(frame.start, &frame == &frames.front());
    EXPECT_EQ(frame.sequence, sequence++);
    const std::uint64_t expected_row = account.next_row;
    account.next_row +=
        static_cast<std::uint32_t>(frame.imu_index - first_index - static_cast<std::uint32_t>(expected_row));
    account.rows_missing += account.next_row - expected_row;
    const bool gap = account.next_row != expected_row;
    for (std::size_t i = 0; i < frame.rows.size(); ++i) {
      reference::Row row = fake_row(account.next_row);
      if (!frame.gyro) row.gyro = {};
      EXPECT_EQ(frame.rows[i], row) << account.next_row;
      const double time_ns = static_cast<double>(frame.time_us) * 1e3 + static_cast<double>(i) * frame.imu_period_ns;
      EXPECT_NEAR(time_ns - rig.board.row_time_ns(account.next_row), 0.0, time_tol_ns) << account.next_row;
      ++account.next_row;
    }
    account.rows += frame.rows.size();
    for (const reference::Force& force : frame.forces) {
      const auto time_us = static_cast<std::uint64_t>(static_cast<std::int64_t>(frame.time_us) + force.offset_us);
      while (static_cast<std::uint64_t>(rig.board.force_time_us(account.next_force)) < time_us) {
        ++account.next_force;
        ++account.forces_missing;
      }
      EXPECT_EQ(static_cast<std::uint64_t>(rig.board.force_time_us(account.next_force)), time_us);
      auto counts = fake_force(account.next_force);
      if (!frame.force3) counts[1] = counts[2] = 0;
      EXPECT_EQ(force.counts, counts) << account.next_force;
      ++account.next_force;
    }
    account.forces += frame.forces.size();
    EXPECT_TRUE(frame.overrun || !gap) << frame.sequence;
    account.needless_overruns += frame.overrun && !gap ? 1 : 0;
    account.overruns += frame.overrun ? 1 : 0;
    if (testing::Test::HasFailure()) break;
  }
  return account;
}

}  // namespace asperity
