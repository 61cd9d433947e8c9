#pragma once

#include "asperity/import/import_mapped.h"

namespace asperity {

// A unit of time that was guessed from a file's values is compared with the times of the other files: poses and sensor
// with each other, a gyroscope, a force or an object of its own file with these. Where another unit (s, ms, µs, ns,
// rows at most 60 kHz) gives times that are the others' much more nearly (their common time over that of both together:
// a quarter at least, and four times that of the guess), it is taken, with a Problem "time_unit" in the table.
void agree_time_units(ImportTables& tables);

// Gives a table's time another unit, and that of all tables that read the same column.
void set_time_unit(ImportTables& tables, const ImportTable& table, const std::string& unit, const std::string& why);

}  // namespace asperity
