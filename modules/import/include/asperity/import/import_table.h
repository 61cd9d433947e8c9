#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "asperity/import/column_map.h"
#include "asperity/import/import_presets.h"
#include "asperity/import/mapping_config.h"

namespace asperity {

// A table with what its columns mean: what is stated, then what the preset knows, then what names and values say.
struct ImportTable {
  DelimitedTable table;
  FileRole role = FileRole::kPose;
  ColumnMap map;
  FilePreset preset;
  double rate_Hz = 0.0;  // of rows without times; 0: they have times
};

// What is known of a table besides its own columns.
struct TableContext {
  std::vector<ColumnGroup> elsewhere{};       // groups of which a stated column may be in another file
  double same_file_Hz = 0.0;                  // the rate that was stated for another role of the same file
  std::vector<FileRole> others{};             // roles that read the same table
  std::vector<const ImportTable*> earlier{};  // the same table, as they have read it
  bool is_given = true;                       // the file was given for this role; false: the role is looked for in it
  bool all_axes = true;                       // as GuessContext has it
};

// Decides it. Columns that MappingConfig::columns states count for a file of `role` if it can have such (times for
// any); those of the role's FileMapping come first. A column that another role of the same table states or has used is
// not guessed, and such a table has one time: the one that was read first, where none is stated for the role. Throws
// Error naming file, column and unit.
ImportTable map_table(DelimitedTable table, FileRole role, const MappingConfig& config,
                      const TableContext& context = {});

// The columns that no role has used, of one file that they read: by their numbers, from 0. Empty ones are left out.
struct UnusedColumns {
  const ImportTable* table = nullptr;
  std::vector<std::size_t> columns;
};
std::vector<UnusedColumns> unused_columns(const std::vector<const ImportTable*>& tables);

// The role's part of the configuration.
const FileMapping& mapping_of(const MappingConfig& config, FileRole role);
FileMapping& mapping_of(MappingConfig& config, FileRole role);

// "poses", "inertial sensor", "gyroscope", "force".
std::string role_name(FileRole role);

// The part of a setting's path, "pose" in mapping.pose.rate_Hz.
std::string setting_name(FileRole role);

}  // namespace asperity
