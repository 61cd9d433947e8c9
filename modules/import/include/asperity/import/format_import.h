#pragma once

#include <string>
#include <vector>

#include "asperity/import/import_mapped.h"
#include "asperity/json/json.h"

namespace asperity {

// The columns, what they are read as and why: a row each with column, meaning, unit, reason, first value and range;
// then the columns that nobody used.
std::string import_table_text(const ImportTables& tables);
// The same in a line a file.
std::string import_summary_text(const ImportTables& tables);
// What the checks found: world's up axis, gravity, rotation, scale, clocks; a line each.
std::string import_checks_text(const ImportedMotion& motion);
// The tracker's noise and where it is from: a line.
std::string tracker_sigma_text(const TrackerSigma& sigma);

// The columns that nobody used, a line a file; "" for none.
std::string unused_columns_text(const std::vector<const ImportTable*>& tables);
Json unused_columns_json(const std::vector<const ImportTable*>& tables);

Json import_json(const ImportTables& tables, const ImportedMotion& motion);

}  // namespace asperity
