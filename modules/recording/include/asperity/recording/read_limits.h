#pragma once

#include <cstdint>

namespace asperity {

// Input files are hostile: these bounds are checked before memory is taken or time is spent.
struct ReadLimits {
  std::uint64_t csv_bytes = std::uint64_t{4} << 30;
  std::uint64_t json_bytes = std::uint64_t{64} << 20;
  int json_depth = 32;                   // nesting of objects and arrays
  std::int64_t json_values = 1'000'000;  // values in one file
  double largest_gap_s = 3600.0;         // rows beyond a longer gap than this are left out
  double longest_span_s = 86400.0;       // of one stream
  double largest_counts = 1e12;          // a sample beyond is not a reading
  double largest_position_m = 1e4;       // a position beyond is not a pose
};

}  // namespace asperity
