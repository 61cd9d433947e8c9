#include "time_order.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr double kSecond_ns = 1e9;

// The longest stretch of `rows`, in number of rows, without a gap longer than `largest_gap_ns`.
std::vector<std::size_t> longest_part(const std::vector<std::size_t>& rows, const std::vector<std::int64_t>& t_ns,
                                      double largest_gap_ns) {
  std::size_t best_start = 0;
  std::size_t best_count = 0;
  std::size_t start = 0;
  for (std::size_t i = 1; i <= rows.size(); ++i) {
    const bool ends = i == rows.size() || static_cast<double>(t_ns[rows[i]] - t_ns[rows[i - 1]]) > largest_gap_ns;
    if (!ends) continue;
    if (i - start > best_count) {
      best_start = start;
      best_count = i - start;
    }
    start = i;
  }
  const auto first = rows.begin() + static_cast<std::ptrdiff_t>(best_start);
  return {first, first + static_cast<std::ptrdiff_t>(best_count)};
}

}  // namespace

void RowProblems::add(const char* kind, std::size_t line, const char* message) {
  for (auto& entry : entries_) {
    if (std::string_view(entry.kind) == kind) {
      ++entry.count;
      entry.line = std::min(entry.line, line);
      return;
    }
  }
  entries_.push_back({kind, message, line, 1});
}

void RowProblems::append_to(Problems& problems) const {
  for (const auto& entry : entries_) {
    problems.push_back({entry.kind, fmt::format("{}:{}: {}", name_, entry.line, entry.message), entry.count});
  }
}

RowOrder order_rows(const std::vector<std::int64_t>& t_ns, const std::vector<std::uint32_t>& line,
                    const std::string& name, const ReadLimits& limits, RowProblems& problems) {
  if (t_ns.empty()) throw Error(name + ": no usable rows");
  const double largest_gap_ns = limits.largest_gap_s * kSecond_ns;
  RowOrder order;
  bool sorted = true;
  for (std::size_t i = 1; i < t_ns.size(); ++i) {
    const std::int64_t step_ns = t_ns[i] - t_ns[i - 1];
    if (step_ns < 0) {
      problems.add("time_backwards", line[i], "the time goes backwards; the rows were sorted by time");
      sorted = false;
    }
    if (step_ns <= 0 || static_cast<double>(step_ns) > largest_gap_ns) order.unchanged = false;
  }
  if (!order.unchanged) {
    std::vector<std::size_t> by_time(t_ns.size());
    std::iota(by_time.begin(), by_time.end(), std::size_t{0});
    if (!sorted) {
      std::stable_sort(by_time.begin(), by_time.end(), [&](std::size_t a, std::size_t b) { return t_ns[a] < t_ns[b]; });
    }
    std::vector<std::size_t> distinct;
    distinct.reserve(by_time.size());
    for (const std::size_t row : by_time) {
      if (!distinct.empty() && t_ns[row] == t_ns[distinct.back()]) {
        problems.add("duplicate_time", line[row], "the time of an earlier row again; the later row was left out");
      } else {
        distinct.push_back(row);
      }
    }
    order.rows = longest_part(distinct, t_ns, largest_gap_ns);
    const std::int64_t first_ns = t_ns[order.rows.front()];
    const std::int64_t last_ns = t_ns[order.rows.back()];
    for (const std::size_t row : distinct) {
      if (t_ns[row] < first_ns || t_ns[row] > last_ns) {
        problems.add("time_far_off", line[row],
                     "the time is beyond a gap that is too long for one recording; such rows were left out");
      }
    }
  }
  const std::int64_t first_ns = order.unchanged ? t_ns.front() : t_ns[order.rows.front()];
  const std::int64_t last_ns = order.unchanged ? t_ns.back() : t_ns[order.rows.back()];
  const double span_s = static_cast<double>(last_ns - first_ns) / kSecond_ns;
  if (span_s > limits.longest_span_s) {
    throw Error(
        fmt::format("{}: its times span {} s, more than the limit of {} s", name, span_s, limits.longest_span_s));
  }
  return order;
}

}  // namespace asperity
