#include "stroke_streams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/import/file_streams.h"

namespace asperity {

namespace {

constexpr double kLowestRate_Hz = 200.0, kSpeedHalf_s = 0.04;
constexpr double kLargestGap = 10.0;  // intervals
constexpr double kSameRate = 0.01;    // of the axes of an accelerometer
constexpr double kUneven = 0.1;       // of the interval, RMS

StrokeSeries series_of(const std::vector<std::int64_t>& t_ns, std::vector<double> value, std::int64_t from_ns) {
  StrokeSeries out;
  for (const std::int64_t t : t_ns) out.t_s.push_back(1e-9 * static_cast<double>(t - from_ns));
  out.value = std::move(value);
  return out;
}

double mean_rate_Hz(const std::vector<double>& t_s) {
  return static_cast<double>(t_s.size() - 1) / (t_s.back() - t_s.front());
}

// Straight lines over a gap would be values that nobody measured.
void refuse_gaps(const std::vector<double>& t_s, const std::string& file, const std::string& quantity) {
  const double rate_Hz = mean_rate_Hz(t_s);
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    if ((t_s[i] - t_s[i - 1]) * rate_Hz > kLargestGap)
      throw Error(fmt::format("{}: a gap of {:.3g} s in {} at {:.6g} s; import the parts one by one", file,
                              t_s[i] - t_s[i - 1], quantity, t_s[i - 1]));
  }
}

// The intervals' scatter about their mean, in intervals.
double scatter_of(const std::vector<double>& t_s, double rate_Hz) {
  double squares = 0.0;
  for (std::size_t i = 1; i < t_s.size(); ++i) squares += std::pow((t_s[i] - t_s[i - 1]) * rate_Hz - 1.0, 2);
  return std::sqrt(squares / static_cast<double>(t_s.size() - 1));
}

}  // namespace

double StrokeSeries::at(double t) const {
  const auto next = std::upper_bound(t_s.begin(), t_s.end(), t);
  if (next == t_s.end()) return value.back();
  if (next == t_s.begin()) return value.front();
  const auto i = static_cast<std::size_t>(next - t_s.begin());
  const double share = (t - t_s[i - 1]) / (t_s[i] - t_s[i - 1]);
  return value[i - 1] + share * (value[i] - value[i - 1]);
}

void add_stroke_acceleration(const ImportTable& table, std::size_t index, StrokeAcceleration& out, Problems& problems) {
  const std::size_t before = out.axes.size();
  for (const char* meaning : {"ax", "ay", "az"}) {
    const MappedColumn* column = find_meaning(table.map, meaning);
    if (column == nullptr) continue;
    ScalarStream stream = read_scalars(table, meaning, problems);
    if (out.axes.empty()) out.start_ns = stream.t_ns.front();
    out.axes.push_back(series_of(stream.t_ns, std::move(stream.value), out.start_ns));
    out.table.push_back(index);
    out.column.push_back(table.table.describe(column->column));
  }
  if (out.axes.size() == before)
    throw Error(table.table.file + ": no column is an acceleration: name it, as ax=NAME[m/s2] or ax=#1[g]");
}

void check_stroke_acceleration(const std::vector<ImportTable>& tables, StrokeAcceleration& out, Problems& problems) {
  double uneven = 0.0;
  std::size_t dead = 0;
  for (std::size_t k = 0; k < out.axes.size(); ++k) {
    const std::vector<double>& t_s = out.axes[k].t_s;
    const std::string& file = tables[out.table[k]].table.file;
    const std::string quantity = "the acceleration (" + out.column[k] + ")";
    if (t_s.size() < 2) throw Error(fmt::format("{}: fewer than two samples of {}", file, quantity));
    refuse_gaps(t_s, file, quantity);
    const double rate_Hz = mean_rate_Hz(t_s);
    if (rate_Hz < kLowestRate_Hz)
      throw Error(fmt::format("{}: {:.4g} samples of {} a second; textures need {:g} at least", file, rate_Hz, quantity,
                              kLowestRate_Hz));
    if (k == 0) out.rate_Hz = rate_Hz;
    if (std::abs(rate_Hz / out.rate_Hz - 1.0) > kSameRate)
      throw Error(
          fmt::format("{}: {} has {:.6g} samples a second, its first axis {:.6g}: the axes of an accelerometer "
                      "have one rate",
                      file, quantity, rate_Hz, out.rate_Hz));
    uneven = std::max(uneven, scatter_of(t_s, rate_Hz));
    const auto [low, high] = std::minmax_element(out.axes[k].value.begin(), out.axes[k].value.end());
    dead += *low == *high ? 1 : 0;
  }
  const std::string& first = tables.front().table.file;
  if (uneven > kUneven)
    problems.push_back({"uneven_times",
                        fmt::format("{}: the acceleration's intervals scatter by {:.0f} %: straight lines between its "
                                    "samples weaken high frequencies",
                                    first, 100.0 * uneven),
                        1});
  if (dead == out.axes.size()) throw Error(first + ": the acceleration never changes");
  if (dead > 0)
    problems.push_back({"axis_constant",
                        fmt::format("{}: {} of {} axes of the acceleration never change", first, dead, out.axes.size()),
                        dead});
}

StrokePath read_stroke_path(const ImportTable& table, std::int64_t start_ns, Problems& problems) {
  StrokePath out;
  for (const char* meaning : {"px", "py", "pz"}) {
    if (find_meaning(table.map, meaning) == nullptr) continue;
    ScalarStream stream = read_scalars(table, meaning, problems);
    out.axes.push_back(series_of(stream.t_ns, std::move(stream.value), start_ns));
  }
  if (out.axes.empty()) throw Error(table.table.file + ": no column is a position: name it, as px=NAME[mm]");
  for (const StrokeSeries& axis : out.axes) {
    if (axis.t_s.size() < 3) throw Error(table.table.file + ": fewer than three positions");
    refuse_gaps(axis.t_s, table.table.file, "the positions");
  }
  const std::vector<double>& t_s = out.axes.front().t_s;
  const double interval_s = (t_s.back() - t_s.front()) / static_cast<double>(t_s.size() - 1);
  const double half_s = std::max(kSpeedHalf_s, 2.0 * interval_s);
  for (const double t : t_s) {
    const double from = std::max(t_s.front(), t - half_s), to = std::min(t_s.back(), t + half_s);
    double squares = 0.0;
    for (const StrokeSeries& axis : out.axes) squares += std::pow((axis.at(to) - axis.at(from)) / (to - from), 2);
    out.speed.t_s.push_back(t);
    out.speed.value.push_back(std::sqrt(squares));
  }
  return out;
}

StrokeSeries read_stroke_force(const ImportTable& table, std::int64_t start_ns, Problems& problems) {
  StrokeSeries out;
  if (find_meaning(table.map, "f") != nullptr) {
    ScalarStream stream = read_scalars(table, "f", problems);
    out = series_of(stream.t_ns, std::move(stream.value), start_ns);
  } else {
    const VectorStream stream = read_vectors(table, 'f', problems);
    std::vector<double> length;
    for (const auto& force : stream.value) length.push_back(force.norm());
    out = series_of(stream.t_ns, std::move(length), start_ns);
  }
  if (out.t_s.size() < 2) throw Error(table.table.file + ": fewer than two samples of the force");
  refuse_gaps(out.t_s, table.table.file, "the force");
  return out;
}

}  // namespace asperity
