#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/import/delimited_table.h"
#include "asperity/recording/read_limits.h"

namespace asperity {

// Reads the table of a delimited text. From its content are found:
// - the encoding: UTF-8 or UTF-16 by the byte order mark; bytes that are not UTF-8 are read as Latin-1 and noted;
// - the separator, of tab, semicolon, comma and blanks: the one with most numbers and least text between;
// - the decimal mark: a comma if cells such as "1,5" are numbers and none has a point;
// - where the rows begin: three lines (or all there are) whose cells are numbers for the greater part;
// - the header: the lines above up to a blank line, or the last comment line (#, %, //) if it has as many cells. A row
// of
//   units, and units behind names ("X [mm]", "acc_x (g)", "F/N"), become the columns' units.
// Blank cells are missing values; a shorter row's last cells are too. Cells may be quoted. The table ends at a blank
// line with text behind it, which is noted; `section` is the line above the table to be read (of Vicon's files, say).
// A last line without its newline may be cut off: it is left out and noted, as in our own files.
// Linear in the text. Throws Error naming file, line and column for a row with more cells than the first, an open
// quote, points and commas as decimal marks, more than 1000 columns, or if no table is found; Cancelled.
DelimitedTable read_delimited(std::string text, const std::string& name, std::string_view section = {},
                              const Observer& observer = {});

// The same of a file. Throws Error if it cannot be read or is larger than the limit.
DelimitedTable read_delimited_file(const std::filesystem::path& path, std::string_view section = {},
                                   const ReadLimits& limits = {});

}  // namespace asperity
