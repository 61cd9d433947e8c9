#include "asperity/import/read_stroke.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/import/file_streams.h"
#include "asperity/import/read_delimited.h"
#include "asperity/recording/read_limits.h"
#include "asperity/signal/zero_phase.h"
#include "join_axes.h"

namespace asperity {

namespace {

constexpr double kLowestRate_Hz = 200.0, kShortestStroke_s = 0.5, kSpeedHalf_s = 0.04;
constexpr double kLargestGap = 10.0;      // intervals
constexpr double kMostDuplicates = 0.01;  // of the rows
constexpr double kUneven = 0.1;           // of the interval, RMS

// A stream on the acceleration's clock, by straight lines.
struct Series {
  std::vector<double> t_s, value;

  double at(double t) const {
    const auto next = std::upper_bound(t_s.begin(), t_s.end(), t);
    if (next == t_s.end()) return value.back();
    if (next == t_s.begin()) return value.front();
    const auto i = static_cast<std::size_t>(next - t_s.begin());
    const double share = (t - t_s[i - 1]) / (t_s[i] - t_s[i - 1]);
    return value[i - 1] + share * (value[i] - value[i - 1]);
  }
};

Series series_of(const std::vector<std::int64_t>& t_ns, std::vector<double> value, std::int64_t from_ns) {
  Series out;
  for (const std::int64_t t : t_ns) out.t_s.push_back(1e-9 * static_cast<double>(t - from_ns));
  out.value = std::move(value);
  return out;
}

ImportTable read_table(const std::filesystem::path& path, FileRole role, const MappingConfig& mapping) {
  // Each file has its own columns: what is stated for all may be in another.
  const std::vector<ColumnGroup> elsewhere{ColumnGroup::kTime,         ColumnGroup::kPosition, ColumnGroup::kRotation,
                                           ColumnGroup::kAcceleration, ColumnGroup::kRate,     ColumnGroup::kForce};
  DelimitedTable table =
      read_delimited(read_file(path, ReadLimits{}.csv_bytes), path.string(), mapping_of(mapping, role).section);
  for (const Problem& problem : table.problems) {
    // In a single column a line of text begins another part of the file: of a stroke that would be a silent loss.
    if (problem.kind == "further_table" && table.columns.size() == 1)
      throw Error(problem.message + "; a stroke's column has numbers only");
  }
  return map_table(std::move(table), role, mapping, elsewhere);
}

// A column that names no quantity is what the file was given for, if there is no other.
void take_only_column(ImportTable& table, const char* meaning, const char* unit) {
  if (table.table.columns.size() != 1 || !table.map.empty()) return;
  const std::string& stated = table.table.columns.front().unit;
  const std::string name =
      stated.empty() ? unit : parse_import_unit(stated, quantity_of(meaning), table.table.describe(0)).name;
  table.map.push_back({meaning, 0, name, false, "the only column", stated.empty() ? "assumed" : "header"});
}

// For a file in which a stream is looked for that it was not given for: its rate is that of what it was given for.
MappingConfig with_rate(MappingConfig mapping, FileRole role, FileRole given) {
  FileMapping& file = mapping_of(mapping, role);
  const FileMapping& other = mapping_of(mapping, given);
  if (file.rate_Hz <= 0.0) file.rate_Hz = other.rate_Hz;
  if (file.section.empty()) file.section = other.section;
  return mapping;
}

struct Acceleration {
  std::vector<Series> axes;
  std::int64_t start_ns = 0;
  double rate_Hz = 0.0;
};

void add_acceleration(const ImportTable& table, Acceleration& out, Problems& problems) {
  const std::size_t before = out.axes.size();
  for (const char* meaning : {"ax", "ay", "az"}) {
    if (find_meaning(table.map, meaning) == nullptr) continue;
    ScalarStream stream = read_scalars(table, meaning, problems);
    if (out.axes.empty()) out.start_ns = stream.t_ns.front();
    out.axes.push_back(series_of(stream.t_ns, std::move(stream.value), out.start_ns));
  }
  if (out.axes.size() == before)
    throw Error(table.table.file + ": no column is an acceleration: name it, as ax=NAME[m/s2] or ax=#1[g]");
  for (const Problem& problem : problems) {
    if (problem.kind != "duplicate_time" ||
        static_cast<double>(problem.count) <= kMostDuplicates * static_cast<double>(table.table.rows()))
      continue;
    throw Error(problem.message + ": its clock is too coarse for its rate; state the rate instead of the times");
  }
}

// The mean rate; throws where there are gaps or too few samples, and where an axis never changes.
void check_acceleration(const ImportTable& table, Acceleration& out, Problems& problems) {
  const std::string& file = table.table.file;
  const std::vector<double>& t_s = out.axes.front().t_s;
  if (t_s.size() < 2) throw Error(file + ": fewer than two samples of the acceleration");
  out.rate_Hz = static_cast<double>(t_s.size() - 1) / (t_s.back() - t_s.front());
  if (out.rate_Hz < kLowestRate_Hz)
    throw Error(fmt::format("{}: {:.4g} samples of the acceleration a second; textures need {:g} at least", file,
                            out.rate_Hz, kLowestRate_Hz));
  double squares = 0.0;
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    const double intervals = (t_s[i] - t_s[i - 1]) * out.rate_Hz;
    if (intervals > kLargestGap)
      throw Error(fmt::format("{}: a gap of {:.3g} s in the acceleration at {:.6g} s; import the parts one by one",
                              file, t_s[i] - t_s[i - 1], t_s[i - 1]));
    squares += (intervals - 1.0) * (intervals - 1.0);
  }
  const double uneven = std::sqrt(squares / static_cast<double>(t_s.size() - 1));
  if (uneven > kUneven)
    problems.push_back({"uneven_times",
                        fmt::format("{}: the acceleration's intervals scatter by {:.0f} %: straight lines between its "
                                    "samples weaken high frequencies",
                                    file, 100.0 * uneven),
                        1});
  std::size_t dead = 0;
  for (const Series& axis : out.axes) {
    const auto [low, high] = std::minmax_element(axis.value.begin(), axis.value.end());
    dead += *low == *high ? 1 : 0;
  }
  if (dead == out.axes.size()) throw Error(file + ": the acceleration never changes");
  if (dead > 0)
    problems.push_back({"axis_constant",
                        fmt::format("{}: {} of {} axes of the acceleration never change", file, dead, out.axes.size()),
                        dead});
}

struct Path {
  std::vector<Series> axes;
  Series speed;
};

Path read_path(const ImportTable& table, std::int64_t start_ns, Problems& problems) {
  Path out;
  for (const char* meaning : {"px", "py", "pz"}) {
    if (find_meaning(table.map, meaning) == nullptr) continue;
    ScalarStream stream = read_scalars(table, meaning, problems);
    out.axes.push_back(series_of(stream.t_ns, std::move(stream.value), start_ns));
  }
  if (out.axes.empty()) throw Error(table.table.file + ": no column is a position: name it, as px=NAME[mm]");
  const std::vector<double>& t_s = out.axes.front().t_s;
  if (t_s.size() < 3) throw Error(table.table.file + ": fewer than three positions");
  const double interval_s = (t_s.back() - t_s.front()) / static_cast<double>(t_s.size() - 1);
  const double half_s = std::max(kSpeedHalf_s, 2.0 * interval_s);
  for (const double t : t_s) {
    const double from = std::max(t_s.front(), t - half_s), to = std::min(t_s.back(), t + half_s);
    double squares = 0.0;
    for (const Series& axis : out.axes) squares += std::pow((axis.at(to) - axis.at(from)) / (to - from), 2);
    out.speed.t_s.push_back(t);
    out.speed.value.push_back(std::sqrt(squares));
  }
  return out;
}

Series read_force(const ImportTable& table, std::int64_t start_ns, Problems& problems) {
  if (find_meaning(table.map, "f") != nullptr) {
    ScalarStream stream = read_scalars(table, "f", problems);
    return series_of(stream.t_ns, std::move(stream.value), start_ns);
  }
  const VectorStream stream = read_vectors(table, 'f', problems);
  std::vector<double> length;
  for (const auto& force : stream.value) length.push_back(force.norm());
  return series_of(stream.t_ns, std::move(length), start_ns);
}

bool has_times(const ImportTable& table) { return find_meaning(table.map, "t") != nullptr; }

// The part of time that all series have.
class CommonTime {
 public:
  CommonTime(const ImportTable& first, const Series& series)
      : file_(first.table.file), timed_(has_times(first)), to_(series.t_s.back()) {}

  void take(const ImportTable& table, const Series& series) {
    if (has_times(table) != timed_)
      throw Error(fmt::format("{} has {}, {} {}: state times of both, or rates of both", table.table.file,
                              timed_ ? "no times" : "times", file_, timed_ ? "has" : "has none"));
    from_ = std::max(from_, series.t_s.front());
    to_ = std::min(to_, series.t_s.back());
    if (length() < kShortestStroke_s)
      throw Error(fmt::format("{}: its times have {:.3g} s in common with {}; a stroke needs {:g} s", table.table.file,
                              std::max(0.0, length()), file_, kShortestStroke_s));
  }
  double from() const { return from_; }
  double to() const { return to_; }
  double length() const { return to_ - from_; }

 private:
  std::string file_;
  bool timed_;
  double from_ = 0.0;
  double to_;
};

// A column that --columns names must be in one of the files at least.
void require_stated(const MappingConfig& mapping, const std::vector<ImportTable>& tables) {
  for (const StatedColumn& column : parse_columns(mapping.columns, mapping.quaternion, "columns")) {
    const bool found = std::any_of(tables.begin(), tables.end(), [&](const ImportTable& table) {
      const MappedColumn* mapped = find_meaning(table.map, column.meaning);
      return mapped != nullptr && mapped->why == "stated";
    });
    if (!found) find_stated_column(column, tables.front().table);  // throws, with the columns that there are
  }
}

std::vector<double> series_values(const Series& series, const std::vector<double>& t_s) {
  std::vector<double> out;
  out.reserve(t_s.size());
  for (const double t : t_s) out.push_back(series.at(t));
  return out;
}

bool never_changes(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [&](double v) { return v == values.front(); });
}

}  // namespace

StrokeReading read_stroke(const StrokeFiles& files, const MappingConfig& mapping, const StrokeImportConfig& config) {
  StrokeReading out;
  Stroke& stroke = out.stroke;
  const std::vector<std::filesystem::path> imu = files.imu.empty() ? std::vector{files.pose} : files.imu;
  if (imu.size() > 3) throw Error("an acceleration has three axes: more than three files are given for it");
  Acceleration acceleration;
  for (const auto& path : imu) {
    const MappingConfig own = files.imu.empty() ? with_rate(mapping, FileRole::kImu, FileRole::kPose) : mapping;
    out.tables.push_back(read_table(path, FileRole::kImu, own));
    take_only_column(out.tables.back(), "ax", "m/s2");
    add_acceleration(out.tables.back(), acceleration, stroke.problems);
  }
  if (acceleration.axes.size() > 3)
    throw Error(out.tables.back().table.file + ": with it the acceleration has more than three axes");
  check_acceleration(out.tables.front(), acceleration, stroke.problems);
  stroke.axes = static_cast<int>(acceleration.axes.size());
  stroke.rate_Hz = acceleration.rate_Hz;
  CommonTime common(out.tables.front(), acceleration.axes.front());
  for (std::size_t i = 1; i < acceleration.axes.size(); ++i)
    common.take(out.tables[std::min(i, out.tables.size() - 1)], acceleration.axes[i]);

  Path path;
  if (!files.pose.empty()) {
    ImportTable table = read_table(files.pose, FileRole::kPose,
                                   files.imu.empty() ? with_rate(mapping, FileRole::kPose, FileRole::kImu) : mapping);
    if (has_group(table.map, ColumnGroup::kPosition) || !files.imu.empty()) {
      path = read_path(table, acceleration.start_ns, stroke.problems);
      for (const Series& axis : path.axes) common.take(table, axis);
      out.tables.push_back(std::move(table));
    }
  }
  Series force;
  std::vector<std::filesystem::path> force_files{files.force};
  if (files.force.empty()) {
    force_files = {imu.front()};
    if (!files.pose.empty() && files.pose != imu.front()) force_files.push_back(files.pose);
  }
  for (const auto& file : force_files) {
    const FileRole given = !files.force.empty()                        ? FileRole::kForce
                           : file == files.pose && !files.pose.empty() ? FileRole::kPose
                                                                       : FileRole::kImu;
    ImportTable table = read_table(file, FileRole::kForce, with_rate(mapping, FileRole::kForce, given));
    if (!files.force.empty()) take_only_column(table, "f", "N");
    if (!has_group(table.map, ColumnGroup::kForce)) {
      if (files.force.empty()) continue;
      throw Error(table.table.file + ": no column is a force: name it, as f=NAME[N] or f=#1[gf]");
    }
    force = read_force(table, acceleration.start_ns, stroke.problems);
    common.take(table, force);
    out.tables.push_back(std::move(table));
    break;
  }
  require_stated(mapping, out.tables);
  if (common.length() < kShortestStroke_s)
    throw Error(fmt::format("{}: {:.3g} s; a stroke has {:g} s at least", imu.front().string(), common.length(),
                            kShortestStroke_s));

  stroke.start_s = common.from();
  stroke.high_pass_Hz = config.high_pass_Hz;
  stroke.contact_N = config.contact_N;
  stroke.noise_mps2 = config.noise_mps2;
  const auto samples = static_cast<std::size_t>(std::floor(common.length() * stroke.rate_Hz * (1.0 + 1e-12))) + 1;
  std::vector<double> t_s;
  for (std::size_t i = 0; i < samples; ++i)
    t_s.push_back(std::min(common.to(), common.from() + static_cast<double>(i) / stroke.rate_Hz));
  std::vector<std::vector<double>> axes;
  double mean_square = 0.0;
  for (const Series& axis : acceleration.axes) {
    axes.push_back(series_values(axis, t_s));
    double mean = 0.0;
    for (const double v : axes.back()) mean += v / static_cast<double>(samples);
    mean_square += mean * mean;
  }
  stroke.acceleration_mps2 = zero_phase_highpass(join_axes(std::move(axes)), config.high_pass_Hz, stroke.rate_Hz);
  if (!path.axes.empty()) {
    stroke.x_m = series_values(path.axes[0], t_s);
    if (path.axes.size() > 1) stroke.y_m = series_values(path.axes[1], t_s);
    if (path.axes.size() > 2) stroke.z_m = series_values(path.axes[2], t_s);
    stroke.speed_mps = series_values(path.speed, t_s);
    stroke.speed_is_measured = true;
  } else if (config.speed_mps > 0.0) {
    stroke.speed_mps.assign(samples, config.speed_mps);
  }
  if (!force.t_s.empty()) {
    stroke.force_N = series_values(force, t_s);
    stroke.force_is_measured = !never_changes(stroke.force_N);
    if (!stroke.force_is_measured)
      stroke.problems.push_back({"force_constant", "the force never changes: it does not count as measured", 1});
  }
  if (!stroke.force_is_measured) {
    stroke.force_N.clear();
    if (config.force_N > 0.0) stroke.force_N.assign(samples, config.force_N);
  }
  for (const ImportTable& table : out.tables) {
    for (const Problem& problem : table.table.problems) {
      const bool known = std::any_of(stroke.problems.begin(), stroke.problems.end(),
                                     [&](const Problem& p) { return p.message == problem.message; });
      if (!known) stroke.problems.push_back(problem);
    }
  }
  out.doubts = check_stroke(stroke, std::sqrt(mean_square), out.tables);
  return out;
}

std::vector<StrokeOrigin> stroke_origins(const std::vector<ImportTable>& tables) {
  std::vector<StrokeOrigin> out;
  for (const ImportTable& table : tables)
    out.push_back({std::filesystem::path(table.table.file).filename().string(), table.table.bytes, table.table.crc32,
                   columns_text(table.map, table.table), table.rate_Hz});
  return out;
}

}  // namespace asperity
