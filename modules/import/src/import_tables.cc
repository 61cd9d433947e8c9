#include <algorithm>
#include <array>
#include <fstream>

#include <fmt/format.h>
#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/import/import_mapped.h"
#include "asperity/import/read_delimited.h"
#include "split_cells.h"

namespace asperity {

namespace {

ImportTable read_import_table(const std::filesystem::path& path, FileRole role, const MappingConfig& config,
                              const std::vector<ColumnGroup>& elsewhere, const ReadLimits& limits,
                              const Observer& observer, double same_file_Hz = 0.0) {
  observer.update("import", 0.0);
  std::string text = read_file(path, limits.csv_bytes);
  std::string section = mapping_of(config, role).section;
  if (section.empty()) section = preset_section(text, role);
  return map_table(read_delimited(std::move(text), path.string(), section, observer), role, config, elsewhere,
                   same_file_Hz);
}

bool states_force(const MappingConfig& config) {
  for (const std::string& text : {config.columns, config.force.columns}) {
    for (const StatedColumn& column : parse_columns(text, config.quaternion, "columns")) {
      if (group_of(column.meaning) == ColumnGroup::kForce) return true;
    }
  }
  return false;
}

// A time that --columns names must be in one of the files at least.
void require_stated_time(const ImportTables& tables, const MappingConfig& config) {
  for (const StatedColumn& column : parse_columns(config.columns, config.quaternion, "columns")) {
    if (group_of(column.meaning) != ColumnGroup::kTime) continue;
    const auto all = tables.all();
    const bool found = std::any_of(all.begin(), all.end(), [&](const ImportTable* table) {
      const MappedColumn* time = find_meaning(table->map, column.meaning);
      return time != nullptr && time->why == "stated";
    });
    if (!found) find_stated_column(column, all.front()->table);  // throws, with the columns that there are
  }
}

bool begins_with_columns(const std::filesystem::path& path, std::string_view columns) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  constexpr std::size_t kLongestHeader = 4096;
  for (char c = 0; line.size() < kLongestHeader && file.get(c) && c != '\n';) line += c;
  std::vector<std::string_view> cells, wanted;
  std::string_view header = line;
  if (header.starts_with("\xEF\xBB\xBF")) header.remove_prefix(3);
  if (!split_cells(header, ',', cells)) return false;
  split_cells(columns, ',', wanted);
  return std::all_of(wanted.begin(), wanted.end(),
                     [&](std::string_view name) { return std::find(cells.begin(), cells.end(), name) != cells.end(); });
}

}  // namespace

bool has_fixed_columns(const ImportFiles& files) {
  constexpr std::string_view kPoses = "t_s,px_m,py_m,pz_m,qw,qx,qy,qz";
  return !files.imu.empty() && files.gyro.empty() && files.force.empty() && begins_with_columns(files.pose, kPoses) &&
         begins_with_columns(files.imu, "t_s,ax_mps2,ay_mps2,az_mps2,gx_radps,gy_radps,gz_radps") &&
         (files.object.empty() || begins_with_columns(files.object, kPoses));
}

std::vector<const ImportTable*> ImportTables::all() const {
  std::vector<const ImportTable*> out;
  for (const auto* table : {&pose, &imu, &gyro, &force, &object}) {
    if (*table) out.push_back(&**table);
  }
  return out;
}

ImportTables read_import_tables(const ImportFiles& files, const MappingConfig& config, const ReadLimits& limits,
                                const Observer& observer) {
  const bool one_file = files.imu.empty() && files.gyro.empty() && files.force.empty() && files.object.empty();
  const std::filesystem::path& imu = files.imu.empty() ? files.pose : files.imu;
  // Each file has times of its own; rates are in the gyroscope's file if it has one.
  std::vector<ColumnGroup> times, sensor;
  if (!one_file) times = sensor = {ColumnGroup::kTime};
  if (!files.gyro.empty()) sensor.push_back(ColumnGroup::kRate);
  // A rate that is stated for one of the streams of a file is that of its rows.
  const double sensor_Hz = config.imu.rate_Hz > 0.0 ? config.imu.rate_Hz : one_file ? config.pose.rate_Hz : 0.0;
  ImportTables out;
  out.pose =
      read_import_table(files.pose, FileRole::kPose, config, times, limits, observer, one_file ? sensor_Hz : 0.0);
  out.imu = read_import_table(imu, FileRole::kImu, config, sensor, limits, observer, sensor_Hz);
  if (!files.gyro.empty()) out.gyro = read_import_table(files.gyro, FileRole::kGyro, config, times, limits, observer);
  if (!files.force.empty()) {
    out.force = read_import_table(files.force, FileRole::kForce, config, times, limits, observer);
  } else if (states_force(config) || one_file) {
    out.force = read_import_table(imu, FileRole::kForce, config, times, limits, observer, sensor_Hz);
    if (!has_group(out.force->map, ColumnGroup::kForce)) out.force.reset();
  }
  if (!files.object.empty())
    out.object = read_import_table(files.object, FileRole::kPose, config, times, limits, observer);
  require_stated_time(out, config);
  return out;
}

namespace {

// "ax=-'Y'[g], ay=…": the columns of a group in the order and with the signs of `axes`, such as "-y,x,z".
std::string exchanged_columns(const ImportTable& table, ColumnGroup group, std::string_view axes) {
  std::array<const MappedColumn*, 3> columns{};
  for (const MappedColumn& column : table.map) {
    if (group_of(column.meaning) == group) columns[static_cast<std::size_t>(column.meaning.back() - 'x') % 3] = &column;
  }
  std::string out;
  bool negative = false;
  std::size_t at = 0;
  for (const char c : axes) {
    negative = negative || c == '-';
    if (c < 'x' || c > 'z') continue;
    const MappedColumn* column = columns[static_cast<std::size_t>(c - 'x')];
    if (column == nullptr || columns[at] == nullptr) return {};
    const std::string sign = negative != column->negative ? "-" : "";
    out += fmt::format("{}{}={}#{}[{}]", out.empty() ? "" : ", ", columns[at]->meaning, sign, column->column + 1,
                       column->unit);
    negative = false;
    ++at;
  }
  return out;
}

}  // namespace

std::string doubt_text(const ImportDoubt& doubt, const ImportTables& tables, const SettingText& text_of) {
  const ImportTable* table = doubt.role == FileRole::kPose ? &*tables.pose : &*tables.imu;
  if (doubt.group == ColumnGroup::kRate && tables.gyro) table = &*tables.gyro;
  std::string names, stated, unit;
  for (const MappedColumn& column : table->map) {
    if (group_of(column.meaning) != doubt.group || column.meaning == "t2") continue;
    const std::string label = table->table.columns[column.column].label();
    const std::string name = label.empty() ? "#" + std::to_string(column.column + 1) : printable(label);
    names += (names.empty() ? "'" : ", '") + name + "'";
    stated += fmt::format("{}{}={}[{}]", stated.empty() ? "" : ", ", column.meaning, name, doubt.unit);
    unit = column.unit;
  }
  std::string out = table->table.file + ": ";
  if (!names.empty()) {
    out += fmt::format("{} {}", names.find(',') == std::string::npos ? "column" : "columns", names);
    out += unit == "1" || unit.empty() ? ": " : fmt::format(" read in {}: ", unit);
  }
  out += doubt.message;
  if (!doubt.unit.empty()) out += "; state " + stated;
  const std::string left_handed =
      doubt.left_handed ? text_of({"mapping.left_handed", *doubt.left_handed ? "true" : "false"}) : "";
  if (doubt.left_handed == true) out += "; where the poses' world is left-handed, state " + left_handed + " first";
  for (std::size_t i = 0; i < doubt.settings.size(); ++i)
    out += (i == 0 ? "; state " : " ") + text_of(doubt.settings[i]);
  if (doubt.left_handed == false) out += ", or " + left_handed;
  if (!doubt.axes.empty()) out += "; state " + exchanged_columns(*table, doubt.group, doubt.axes);
  return out;
}

}  // namespace asperity
