#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/recording/read_limits.h"

namespace asperity {

// Times beyond ±2^62 ns (146 years) are no readings of a clock; within, differences cannot overflow.
inline constexpr std::int64_t kLatestTime_ns = std::int64_t{1} << 62;

// Counts what was wrong with rows, by kind, and remembers the first line of each.
class RowProblems {
 public:
  explicit RowProblems(std::string name) : name_(std::move(name)) {}
  // `message` completes "file:line: …".
  void add(const char* kind, std::size_t line, const char* message);
  void append_to(Problems& problems) const;

 private:
  struct Entry {
    const char* kind;
    const char* message;
    std::size_t line;
    std::size_t count;
  };
  std::string name_;
  std::vector<Entry> entries_;
};

// Which rows to keep, in which order, so that times rise strictly without an absurd gap: sorts, keeps
// the first row of equal times, and where gaps are longer than allowed, the part with most rows.
// `line[i]` is the line of row i. Throws Error if no row is left or the span is too long.
struct RowOrder {
  bool unchanged = true;
  std::vector<std::size_t> rows;

  template <class T>
  void apply(std::vector<T>& values) const {
    if (unchanged || values.empty()) return;
    std::vector<T> kept;
    kept.reserve(rows.size());
    for (const std::size_t row : rows) kept.push_back(values[row]);
    values = std::move(kept);
  }
};

RowOrder order_rows(const std::vector<std::int64_t>& t_ns, const std::vector<std::uint32_t>& line,
                    const std::string& name, const ReadLimits& limits, RowProblems& problems);

}  // namespace asperity
