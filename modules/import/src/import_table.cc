#include "asperity/import/import_table.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include "asperity/base/error.h"

namespace asperity {

namespace {

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

ImportTable map_table(DelimitedTable table, FileRole role, const MappingConfig& config,
                      const std::vector<ColumnGroup>& elsewhere, double same_file_Hz) {
  ImportTable out;
  const FileMapping& file = mapping_of(config, role);
  out.role = role;
  out.preset = find_preset(table, role, file.preset);
  add_stated(table, role, parse_columns(file.columns, config.quaternion, "columns of the " + role_name(role)), {}, true,
             out.map);
  add_stated(table, role, parse_columns(config.columns, config.quaternion, "columns"), elsewhere, false, out.map);
  add_preset_columns(out.preset, role, out.map);
  const std::string name = std::filesystem::path(table.file).filename().string();
  // A rate is stated for a file without times: a column that looks like one is none.
  const ColumnMap before = out.map;
  guess_columns(table, role, name, file.body, out.map);
  const double stated_Hz = file.rate_Hz > 0.0 || out.preset.rate_Hz > 0.0 ? file.rate_Hz : same_file_Hz;
  if (stated_Hz > 0.0 && !has_group(before, ColumnGroup::kTime)) {
    std::erase_if(out.map, [](const MappedColumn& column) { return group_of(column.meaning) == ColumnGroup::kTime; });
  }
  use_preset_units(table, out.preset, out.map);
  guess_units(table, out.map);
  if (find_meaning(out.map, "t") == nullptr) {
    out.rate_Hz = stated_Hz > 0.0 ? stated_Hz : out.preset.rate_Hz;
    if (out.rate_Hz <= 0.0) {
      const char* of = role == FileRole::kPose   ? "pose"
                       : role == FileRole::kImu  ? "imu"
                       : role == FileRole::kGyro ? "gyro"
                                                 : "force";
      throw UnstatedSetting(
          table.file + ": no column is a time: name it (t=NAME[ms] or t=#1[ms]), or state the rate of the rows",
          {fmt::format("mapping.{}.rate_Hz", of), "500"});
    }
  }
  out.table = std::move(table);
  return out;
}

}  // namespace asperity
