#include "asperity/device/write_flight_record.h"

#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/device/safety_cause.h"
#include "asperity/testkit/temp_dir.h"
#include "flight_recorder.h"

namespace asperity {
namespace {

TEST(FlightRecorder, KeepsTheNewestInOrder) {
  FlightRecorder recorder(5);
  for (std::int64_t k = 0; k < 3; ++k) {
    ServoTick tick;
    tick.t_ns = k;
    recorder.push(tick);
  }
  const std::vector<ServoTick> few = recorder.take();
  ASSERT_EQ(few.size(), 3U);
  EXPECT_EQ(few[0].t_ns, 0);
  FlightRecorder full(5);
  for (std::int64_t k = 0; k < 13; ++k) {
    ServoTick tick;
    tick.t_ns = k;
    full.push(tick);
  }
  const std::vector<ServoTick> last = full.take();
  ASSERT_EQ(last.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(last[k].t_ns, static_cast<std::int64_t>(8 + k));
  EXPECT_TRUE(full.take().empty());
}

TEST(WriteFlightRecord, WritesWhatHappened) {
  ServoTick tick;
  tick.t_ns = 123;
  tick.reading.status = DeviceStatus::kFault;
  tick.reading.p_m = {0.25, -0.5, 1.0};
  tick.output.force_N.z() = 1.5;
  tick.out_world_N.z() = 0.75;
  tick.limited_by = flag(SafetyCause::kFault) | flag(SafetyCause::kRateLimit);
  tick.late_ns = 77;
  const testkit::TempDir dir;
  write_flight_record(dir / "record.csv", std::vector{tick, ServoTick{}});
  const std::string text = read_file(dir / "record.csv", 1 << 20);
  CsvReader csv(text, "record.csv");
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.integer(csv.require("t_ns")), 123);
  EXPECT_EQ(csv.cell(csv.require("status")), "fault");
  EXPECT_EQ(csv.number(csv.require("device_y_m")), -0.5);
  EXPECT_EQ(csv.number(csv.require("fz_N")), 1.5);
  EXPECT_EQ(csv.number(csv.require("out_z_N")), 0.75);
  EXPECT_EQ(csv.cell(csv.require("limited_by")), "fault+rate-limit");
  EXPECT_EQ(csv.cell(csv.require("object")), "");
  EXPECT_EQ(csv.integer(csv.require("late_ns")), 77);
  ASSERT_TRUE(csv.next());
  EXPECT_FALSE(csv.next());
  EXPECT_THROW(write_flight_record(dir / "no" / "record.csv", {}), Error);
}

}  // namespace
}  // namespace asperity
