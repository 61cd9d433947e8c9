#include "asperity/import/read_stroke.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/import/read_delimited.h"
#include "asperity/recording/read_limits.h"
#include "asperity/signal/zero_phase.h"
#include "join_axes.h"
#include "stroke_streams.h"

namespace asperity {

namespace {

constexpr double kShortestStroke_s = 0.5;

// The roles that read a file.
std::vector<FileRole> roles_of(const std::filesystem::path& path, const StrokeFiles& files) {
  std::vector<FileRole> out;
  if (files.imu.empty() || std::find(files.imu.begin(), files.imu.end(), path) != files.imu.end())
    out.push_back(FileRole::kImu);
  if (path == files.pose) out.push_back(FileRole::kPose);
  if (path == files.force || files.force.empty()) out.push_back(FileRole::kForce);
  return out;
}

ImportTable read_table(const std::filesystem::path& path, FileRole role, const MappingConfig& mapping,
                       const StrokeFiles& files, const std::vector<ImportTable>& tables) {
  // Each file has its own columns: what is stated for all may be in another.
  TableContext context{{ColumnGroup::kTime, ColumnGroup::kPosition, ColumnGroup::kRotation, ColumnGroup::kAcceleration,
                        ColumnGroup::kRate, ColumnGroup::kForce}};
  context.others = roles_of(path, files);
  std::erase(context.others, role);
  for (const ImportTable& other : tables) {
    if (other.table.file == path.string()) context.earlier.push_back(&other);
  }
  context.is_given = role != FileRole::kForce || path == files.force;
  context.all_axes = false;
  DelimitedTable table =
      read_delimited(read_file(path, ReadLimits{}.csv_bytes), path.string(), mapping_of(mapping, role).section);
  for (const Problem& problem : table.problems) {
    // In a single column a line of text begins another part of the file: of a stroke that would be a silent loss.
    if (problem.kind == "further_table" && table.columns.size() == 1)
      throw Error(problem.message + "; a stroke's column has numbers only");
  }
  return map_table(std::move(table), role, mapping, context);
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

bool has_times(const ImportTable& table) { return find_meaning(table.map, "t") != nullptr; }

// The part of time that all series have.
class CommonTime {
 public:
  CommonTime(const ImportTable& first, const StrokeSeries& series)
      : file_(first.table.file), timed_(has_times(first)), to_(series.t_s.back()) {}

  void take(const ImportTable& table, const StrokeSeries& series) {
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

std::vector<double> series_values(const StrokeSeries& series, const std::vector<double>& t_s) {
  std::vector<double> out;
  out.reserve(t_s.size());
  for (const double t : t_s) out.push_back(series.at(t));
  return out;
}

double rms(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double v : values) squares += v * v;
  return std::sqrt(squares / static_cast<double>(values.size()));
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
  StrokeAcceleration acceleration;
  for (const auto& path : imu) {
    const MappingConfig own = files.imu.empty() ? with_rate(mapping, FileRole::kImu, FileRole::kPose) : mapping;
    out.tables.push_back(read_table(path, FileRole::kImu, own, files, out.tables));
    take_only_column(out.tables.back(), "ax", "m/s2");
    add_stroke_acceleration(out.tables.back(), out.tables.size() - 1, acceleration, stroke.problems);
  }
  if (acceleration.axes.size() > 3)
    throw Error(out.tables.back().table.file + ": with it the acceleration has more than three axes");
  check_stroke_acceleration(out.tables, acceleration, stroke.problems);
  stroke.axes = static_cast<int>(acceleration.axes.size());
  stroke.rate_Hz = acceleration.rate_Hz;
  CommonTime common(out.tables.front(), acceleration.axes.front());
  for (std::size_t i = 1; i < acceleration.axes.size(); ++i)
    common.take(out.tables[acceleration.table[i]], acceleration.axes[i]);

  StrokePath path;
  if (!files.pose.empty()) {
    ImportTable table = read_table(files.pose, FileRole::kPose,
                                   files.imu.empty() ? with_rate(mapping, FileRole::kPose, FileRole::kImu) : mapping,
                                   files, out.tables);
    if (has_group(table.map, ColumnGroup::kPosition) || !files.imu.empty()) {
      path = read_stroke_path(table, acceleration.start_ns, stroke.problems);
      for (const StrokeSeries& axis : path.axes) common.take(table, axis);
      out.tables.push_back(std::move(table));
    }
  }
  StrokeSeries force;
  std::vector<std::filesystem::path> force_files{files.force};
  if (files.force.empty()) {
    force_files = {imu.front()};
    if (!files.pose.empty() && files.pose != imu.front()) force_files.push_back(files.pose);
  }
  for (const auto& file : force_files) {
    const FileRole given = !files.force.empty()                        ? FileRole::kForce
                           : file == files.pose && !files.pose.empty() ? FileRole::kPose
                                                                       : FileRole::kImu;
    ImportTable table =
        read_table(file, FileRole::kForce, with_rate(mapping, FileRole::kForce, given), files, out.tables);
    if (!files.force.empty()) take_only_column(table, "f", "N");
    if (!has_group(table.map, ColumnGroup::kForce)) {
      if (files.force.empty()) continue;
      throw Error(table.table.file + ": no column is a force: name it, as f=NAME[N] or f=#1[gf]");
    }
    force = read_stroke_force(table, acceleration.start_ns, stroke.problems);
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
  std::vector<double> axis_rms_mps2;
  for (const StrokeSeries& axis : acceleration.axes) {
    axes.push_back(series_values(axis, t_s));
    axis_rms_mps2.push_back(rms(zero_phase_highpass(axes.back(), config.high_pass_Hz, stroke.rate_Hz)));
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
  out.doubts = check_stroke(stroke, std::sqrt(mean_square), axis_rms_mps2, out.tables);
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
