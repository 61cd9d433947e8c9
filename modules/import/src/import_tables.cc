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

// One file for one role or several of them; what one role uses is not the others'.
class TablesReader {
 public:
  TablesReader(const MappingConfig& config, const ReadLimits& limits, const Observer& observer)
      : config_(config), limits_(limits), observer_(observer) {}

  // `roles`: all that read this file.
  ImportTable read(const std::filesystem::path& path, FileRole role, const std::vector<FileRole>& roles,
                   const std::vector<const std::optional<ImportTable>*>& earlier, TableContext context) const {
    observer_.update("import", 0.0);
    std::string text = read_file(path, limits_.csv_bytes);
    const std::string section = section_of(text, role);
    for (const FileRole other : roles) {
      if (other != role && section_of(text, other) == section) context.others.push_back(other);
    }
    for (const auto* table : earlier) {
      const bool is_other = std::find(context.others.begin(), context.others.end(), *table ? (*table)->role : role) !=
                            context.others.end();
      if (*table && is_other) context.earlier.push_back(&**table);
    }
    return map_table(read_delimited(std::move(text), path.string(), section, observer_), role, config_, context);
  }

 private:
  std::string section_of(const std::string& text, FileRole role) const {
    const std::string& stated = mapping_of(config_, role).section;
    return stated.empty() ? preset_section(text, role) : stated;
  }

  const MappingConfig& config_;
  const ReadLimits& limits_;
  const Observer& observer_;
};

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

bool has_columns(const std::filesystem::path& path, std::string_view columns) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  constexpr std::size_t kLongestHeader = 4096;
  for (char c = 0; line.size() < kLongestHeader && file.get(c) && c != '\n';) line += c;
  std::vector<std::string_view> cells, wanted;
  std::string_view header = line;
  if (header.starts_with("\xEF\xBB\xBF")) header.remove_prefix(3);
  if (!split_cells(header, ',', cells)) return false;
  split_cells(columns, ',', wanted);
  if (cells.size() != wanted.size()) return false;  // what else there is may be wanted
  return std::all_of(wanted.begin(), wanted.end(),
                     [&](std::string_view name) { return std::find(cells.begin(), cells.end(), name) != cells.end(); });
}

void require_force(const ImportTable& table) {
  if (has_group(table.map, ColumnGroup::kForce)) return;
  throw Error(table.table.file +
              ": no column is a force: name it, as f=NAME[N] or f=#1[gf], or fx, fy, fz; there are " +
              column_list(table.table));
}

// A force among the columns of the other files; those whose unit is not known are left, and named as not used.
template <class Read>
std::optional<ImportTable> find_force(const std::filesystem::path& imu, const std::filesystem::path& pose,
                                      const Read& read, double imu_Hz, double pose_Hz) {
  for (const auto& [path, rate_Hz] : {std::pair(imu, imu_Hz), std::pair(pose, pose_Hz)}) {
    try {
      ImportTable table = read(path, FileRole::kForce, {ColumnGroup::kTime}, rate_Hz, false);
      if (has_group(table.map, ColumnGroup::kForce)) return table;
    } catch (const Error&) {
      continue;
    }
  }
  return std::nullopt;
}

// The columns that are stated may be in the sensor's file or in that of the poses.
template <class Read>
ImportTable read_stated_force(const std::filesystem::path& imu, const std::filesystem::path& pose, const Read& read,
                              double imu_Hz, const std::vector<ColumnGroup>& elsewhere) {
  try {
    return read(imu, FileRole::kForce, elsewhere, imu_Hz, false);
  } catch (const Error&) {
    if (imu == pose) throw;
    try {
      return read(pose, FileRole::kForce, elsewhere, 0.0, false);
    } catch (const Error&) {
    }
    throw;
  }
}

}  // namespace

bool has_fixed_columns(const ImportFiles& files) {
  constexpr std::string_view kPoses = "t_s,px_m,py_m,pz_m,qw,qx,qy,qz";
  return !files.imu.empty() && files.gyro.empty() && files.force.empty() && has_columns(files.pose, kPoses) &&
         has_columns(files.imu, "t_s,ax_mps2,ay_mps2,az_mps2,gx_radps,gy_radps,gz_radps") &&
         (files.object.empty() || has_columns(files.object, kPoses));
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
  const auto roles_of = [&](const std::filesystem::path& path) {
    std::vector<FileRole> out;
    if (path == files.pose) out.push_back(FileRole::kPose);
    if (path == imu) out.push_back(FileRole::kImu);
    if (path == files.gyro) out.push_back(FileRole::kGyro);
    if (path == files.force || (files.force.empty() && path == imu)) out.push_back(FileRole::kForce);
    return out;
  };
  const TablesReader reader(config, limits, observer);
  ImportTables out;
  const auto read = [&](const std::filesystem::path& path, FileRole role, const std::vector<ColumnGroup>& elsewhere,
                        double same_file_Hz = 0.0, bool is_given = true) {
    const auto roles = roles_of(path);
    std::vector<const std::optional<ImportTable>*> earlier;
    for (const auto* table : {&out.pose, &out.imu, &out.gyro}) {
      if (*table && (*table)->table.file == path.string()) earlier.push_back(table);
    }
    return reader.read(path, role, roles, earlier, {elsewhere, same_file_Hz, {}, {}, is_given});
  };
  out.pose = read(files.pose, FileRole::kPose, times, one_file ? sensor_Hz : 0.0);
  out.imu = read(imu, FileRole::kImu, sensor, sensor_Hz);
  if (!files.gyro.empty()) out.gyro = read(files.gyro, FileRole::kGyro, times);
  if (!files.force.empty()) {
    out.force = read(files.force, FileRole::kForce, times);
    require_force(*out.force);
  } else if (states_force(config) || one_file) {
    out.force = read_stated_force(imu, files.pose, read, sensor_Hz, times);
    if (!has_group(out.force->map, ColumnGroup::kForce)) out.force.reset();
  } else {
    out.force = find_force(imu, files.pose, read, config.imu.rate_Hz, config.pose.rate_Hz);
  }
  if (!files.object.empty()) {
    out.object = reader.read(files.object, FileRole::kPose, {}, {}, TableContext{times});
  }
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
