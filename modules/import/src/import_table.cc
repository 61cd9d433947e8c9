#include "asperity/import/import_table.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include "asperity/base/error.h"
#include "asperity/import/stated_setting.h"

namespace asperity {

namespace {

const std::vector<ColumnGroup> kAllGroups{ColumnGroup::kTime,         ColumnGroup::kPosition, ColumnGroup::kRotation,
                                          ColumnGroup::kAcceleration, ColumnGroup::kRate,     ColumnGroup::kForce};

bool may_have(FileRole role, ColumnGroup group) {
  switch (group) {
    case ColumnGroup::kTime:
      return true;
    case ColumnGroup::kPosition:
    case ColumnGroup::kRotation:
      return role == FileRole::kPose;
    case ColumnGroup::kAcceleration:
      return role == FileRole::kImu;
    case ColumnGroup::kRate:
      return role == FileRole::kImu || role == FileRole::kGyro;
    case ColumnGroup::kForce:
      break;
  }
  return role == FileRole::kForce;
}

// Where a column is to be stated that is not of this file's kind.
std::string misplaced(const std::string& file, FileRole role, const StatedColumn& entry) {
  const ColumnGroup group = group_of(entry.meaning);
  const char* option = group == ColumnGroup::kForce          ? "force"
                       : group == ColumnGroup::kAcceleration ? "imu"
                       : group == ColumnGroup::kRate         ? (role == FileRole::kGyro ? "gyro" : "imu")
                                                             : "pose";
  const std::string unit = entry.unit.empty() ? "" : "[" + entry.unit + "]";
  return fmt::format(
      "{}: {} is not a column of the {}: state it as --{} {} --{}-columns \"{}={}{}\", which may be the "
      "same file",
      file, entry.meaning, role_name(role), option, file, option, entry.meaning, entry.column, unit);
}

void add_stated(const DelimitedTable& table, FileRole role, const std::vector<StatedColumn>& stated,
                const std::vector<ColumnGroup>& elsewhere, bool own, ColumnMap& map) {
  for (const StatedColumn& entry : stated) {
    if (!may_have(role, group_of(entry.meaning))) {
      if (own) throw Error(misplaced(table.file, role, entry));
      continue;
    }
    if (find_meaning(map, entry.meaning) != nullptr) continue;
    try {
      map.push_back(find_stated_column(entry, table));
    } catch (const Error&) {
      const ColumnGroup group = group_of(entry.meaning);
      if (std::find(elsewhere.begin(), elsewhere.end(), group) == elsewhere.end()) throw;
    }
  }
}

void add_preset_columns(const FilePreset& preset, FileRole role, ColumnMap& map) {
  const ColumnMap stated = map;
  for (const MappedColumn& column : preset.map) {
    const ColumnGroup group = group_of(column.meaning);
    if (may_have(role, group) && !has_group(stated, group)) map.push_back(column);
  }
}

void use_preset_units(const DelimitedTable& table, const FilePreset& preset, ColumnMap& map) {
  if (preset.length.empty()) return;
  for (MappedColumn& column : map) {
    if (quantity_of(column.meaning) != Quantity::kLength || !column.unit.empty()) continue;
    if (!table.columns[column.column].unit.empty()) continue;
    column.unit = parse_import_unit(preset.length, Quantity::kLength, table.file).name;
    column.unit_why = "preset " + preset.name;
  }
}

// The columns that are stated for a role, with their units.
ColumnMap stated_map(const DelimitedTable& table, FileRole role, const MappingConfig& config,
                     const std::vector<ColumnGroup>& elsewhere) {
  ColumnMap out;
  const std::string of = "columns of the " + role_name(role);
  add_stated(table, role, parse_columns(mapping_of(config, role).columns, config.quaternion, of), {}, true, out);
  add_stated(table, role, parse_columns(config.columns, config.quaternion, "columns"), elsewhere, false, out);
  return out;
}

// Those that other roles of the same table state or have used; times may serve several.
std::vector<std::size_t> taken_columns(const DelimitedTable& table, const MappingConfig& config,
                                       const TableContext& context) {
  std::vector<std::size_t> out;
  const auto add = [&](const ColumnMap& map) {
    for (const MappedColumn& column : map) {
      if (group_of(column.meaning) != ColumnGroup::kTime) out.push_back(column.column);
    }
  };
  for (const FileRole role : context.others) {
    try {
      add(stated_map(table, role, config, kAllGroups));
    } catch (const Error&) {
      continue;  // reported where the role itself is read
    }
  }
  for (const ImportTable* table_of_other : context.earlier) add(table_of_other->map);
  return out;
}

void erase_time(ColumnMap& map) {
  std::erase_if(map, [](const MappedColumn& column) { return group_of(column.meaning) == ColumnGroup::kTime; });
}

// The rows of one table have one time.
void use_time_of(const ImportTable& other, ImportTable& table) {
  erase_time(table.map);
  for (const MappedColumn& column : other.map) {
    if (group_of(column.meaning) == ColumnGroup::kTime) table.map.push_back(column);
  }
  table.rate_Hz = other.rate_Hz;
}

// A file may hold several tables.
bool is_same_table(const DelimitedTable& a, const DelimitedTable& b) {
  const auto begin = [](const DelimitedTable& table) { return table.row_begin.empty() ? 0 : table.row_begin.front(); };
  return a.file == b.file && a.columns.size() == b.columns.size() && begin(a) == begin(b);
}

bool has_content(const DelimitedColumn& column) {
  return !column.label().empty() || column.has_text ||
         std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

const FileMapping& mapping_of(const MappingConfig& config, FileRole role) {
  switch (role) {
    case FileRole::kPose:
      return config.pose;
    case FileRole::kImu:
      return config.imu;
    case FileRole::kGyro:
      return config.gyro;
    case FileRole::kForce:
      break;
  }
  return config.force;
}

FileMapping& mapping_of(MappingConfig& config, FileRole role) {
  return const_cast<FileMapping&>(mapping_of(static_cast<const MappingConfig&>(config), role));
}

std::string role_name(FileRole role) {
  switch (role) {
    case FileRole::kPose:
      return "poses";
    case FileRole::kImu:
      return "inertial sensor";
    case FileRole::kGyro:
      return "gyroscope";
    case FileRole::kForce:
      break;
  }
  return "force";
}

std::string setting_name(FileRole role) {
  return role == FileRole::kPose ? "pose" : role == FileRole::kImu ? "imu" : role == FileRole::kGyro ? "gyro" : "force";
}

ImportTable map_table(DelimitedTable table, FileRole role, const MappingConfig& config, const TableContext& context) {
  ImportTable out;
  const FileMapping& file = mapping_of(config, role);
  out.role = role;
  out.preset = find_preset(table, role, file.preset);
  out.map = stated_map(table, role, config, context.elsewhere);
  const bool states_time = has_group(out.map, ColumnGroup::kTime);
  add_preset_columns(out.preset, role, out.map);
  const std::string name = std::filesystem::path(table.file).filename().string();
  // A rate is stated for a file without times: a column that looks like one is none.
  const ColumnMap before = out.map;
  guess_columns(table, role, name, file.body, out.map,
                {taken_columns(table, config, context), context.is_given, context.all_axes});
  const double stated_Hz = file.rate_Hz > 0.0 || out.preset.rate_Hz > 0.0 ? file.rate_Hz : context.same_file_Hz;
  if (stated_Hz > 0.0 && !has_group(before, ColumnGroup::kTime)) erase_time(out.map);
  use_preset_units(table, out.preset, out.map);
  if (!states_time && !(file.rate_Hz > 0.0) && !context.earlier.empty()) {
    use_time_of(*context.earlier.front(), out);
  } else if (find_meaning(out.map, "t") == nullptr) {
    out.rate_Hz = stated_Hz > 0.0 ? stated_Hz : out.preset.rate_Hz;
  }
  guess_units(table, out.map);
  if (find_meaning(out.map, "t") == nullptr && out.rate_Hz <= 0.0) {
    throw UnstatedSetting(
        table.file + ": no column is a time: name it (t=NAME[ms] or t=#1[ms]), or state the rate of the rows",
        {fmt::format("mapping.{}.rate_Hz", setting_name(role)), "500"});
  }
  out.table = std::move(table);
  return out;
}

std::vector<UnusedColumns> unused_columns(const std::vector<const ImportTable*>& tables) {
  std::vector<UnusedColumns> out;
  std::vector<bool> is_done(tables.size(), false);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (is_done[i]) continue;
    const DelimitedTable& table = tables[i]->table;
    std::vector<bool> is_used(table.columns.size(), false);
    for (std::size_t k = i; k < tables.size(); ++k) {
      if (!is_same_table(table, tables[k]->table)) continue;
      is_done[k] = true;
      for (const MappedColumn& column : tables[k]->map) is_used[column.column] = true;
    }
    UnusedColumns unused{tables[i], {}};
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (!is_used[c] && has_content(table.columns[c])) unused.columns.push_back(c);
    }
    if (!unused.columns.empty()) out.push_back(std::move(unused));
  }
  return out;
}

}  // namespace asperity
