// What servo_shim.c counted of the servo thread, and how it is judged.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

namespace asperity::cli {

struct ServoCounts {
  long waits = 0, allocations = -1, maps = -1, locks = -1, faults = -1;
};

inline ServoCounts read_servo_counts(const std::filesystem::path& file) {
  ServoCounts counts;
  std::ifstream(file) >> counts.waits >> counts.allocations >> counts.maps >> counts.locks >> counts.faults;
  return counts;
}

// Calls `run` until it counts no page fault, at most five times, and expects none of the other calls in any of them.
// The kernel moves locked pages too (compaction, huge pages), and each page that was moved faults once: such a fault
// is of the machine, and seldom. A fault of the program's own comes each time.
inline void expect_no_call_that_could_block(const std::function<ServoCounts()>& run, long least_waits) {
  ServoCounts counts;
  for (int attempt = 0; attempt < 5 && counts.faults != 0; ++attempt) {
    counts = run();
    EXPECT_GT(counts.waits, least_waits);
    EXPECT_EQ(counts.allocations, 0);
    EXPECT_EQ(counts.maps, 0);
    EXPECT_EQ(counts.locks, 0);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(counts.faults, 0) << "in each of five runs";
}

}  // namespace asperity::cli
