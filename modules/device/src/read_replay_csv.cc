#include "asperity/device/read_replay_csv.h"

#include <array>
#include <cmath>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "check_samples.h"

namespace asperity {

namespace {

constexpr std::uint64_t kLargestFile_bytes = 1 << 30;
constexpr double kFarthest_m = 1e6;
constexpr std::int64_t kUntimedRow_ns = 1'000'000;

// The time of the current row; `seconds` if the column is in seconds.
std::int64_t time_ns(const CsvReader& csv, std::size_t column, bool seconds) {
  if (!seconds) {
    const std::int64_t t_ns = csv.integer(column);
    if (t_ns < -kFarthest_ns || t_ns > kFarthest_ns) csv.fail(column, std::to_string(t_ns) + " ns is not a valid time");
    return t_ns;
  }
  const double t_s = csv.number(column);
  if (!(std::abs(t_s) * 1e9 <= static_cast<double>(kFarthest_ns))) {
    csv.fail(column, "'" + printable(csv.cell(column)) + "' is not a time in seconds");
  }
  return std::llround(t_s * 1e9);
}

}  // namespace

ReplayFile parse_replay_csv(std::string_view text, const std::string& name) {
  CsvReader csv(text, name);
  csv.accept_unterminated();
  const std::array<std::size_t, 3> position{csv.require("px_m"), csv.require("py_m"), csv.require("pz_m")};
  const auto nanoseconds = csv.find("t_ns");
  const auto time = nanoseconds ? nanoseconds : csv.find("t_s");

  ReplayFile out;
  std::size_t passed_over = 0;
  std::int64_t row = 0;
  while (csv.next()) {
    ReplaySample sample;
    sample.t_ns = time ? time_ns(csv, *time, !nanoseconds) : row * kUntimedRow_ns;
    ++row;
    for (std::size_t k = 0; k < 3; ++k) {
      const double value_m = csv.number(position[k]);
      if (std::abs(value_m) > kFarthest_m) {
        csv.fail(position[k], "'" + printable(csv.cell(position[k])) + "' is not a position in metres");
      }
      sample.p_m[static_cast<Eigen::Index>(k)] = value_m;
    }
    if (sample.p_m.array().isNaN().any()) {
      ++passed_over;
      continue;
    }
    if (!out.samples.empty() && sample.t_ns <= out.samples.back().t_ns) {
      csv.fail(*time, "'" + printable(csv.cell(*time)) + "': time does not rise");
    }
    out.samples.push_back(sample);
  }
  if (out.samples.empty()) throw Error(name + ": no row with a position");
  if (passed_over > 0) out.problems.push_back({"no_position", "rows without a position were skipped", passed_over});
  return out;
}

ReplayFile read_replay_csv(const std::filesystem::path& file) {
  return parse_replay_csv(read_file(file, kLargestFile_bytes), printable(file.string(), 300));
}

}  // namespace asperity
