#pragma once

#include <string>

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

// Decides it. Columns that MappingConfig::columns states count for a file of `role` if it can have such (times for
// any); those of the role's FileMapping come first. `elsewhere`: groups of which a
// stated column that is not in the table may be in another file. `same_file_Hz`: the rate that was stated for another
// role of the same file. Throws Error naming file, column and unit.
ImportTable map_table(DelimitedTable table, FileRole role, const MappingConfig& config,
                      const std::vector<ColumnGroup>& elsewhere = {}, double same_file_Hz = 0.0);

// The role's part of the configuration.
const FileMapping& mapping_of(const MappingConfig& config, FileRole role);
FileMapping& mapping_of(MappingConfig& config, FileRole role);

// "poses", "inertial sensor", "gyroscope", "force".
std::string role_name(FileRole role);

}  // namespace asperity
