#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace asperity {

// Cells of a line: ';', '\t' and ',' part them, ' ' stands for any run of blanks, 0 for none.
char separator_of(std::string_view line);
std::vector<std::string_view> text_cells(std::string_view line, char separator);

// With a decimal comma or point, in quotes or not; where commas part the cells, with a point.
std::optional<double> cell_number(std::string_view cell);

// What instruments write for a point without a height: nothing, nan, NA, null, bad, dashes, asterisks, "No Data".
bool is_missing_word(std::string_view cell);

// One to three numbers, the last of which may be missing (nan); nullopt for anything else.
std::optional<std::vector<double>> number_row(std::string_view line, char separator);

// Metres of each of `width` columns, by a header line; nullopt if it does not state them all.
std::optional<std::vector<double>> header_units_m(std::string_view line, std::size_t width);

}  // namespace asperity
