#pragma once

#include <string>
#include <string_view>

#include "asperity/profile/read_heights.h"

namespace asperity {

// Whether a text is a table of one to three columns that needs this reader: its first row of numbers is parted by
// semicolons, tabs or blanks, or header lines above it state units otherwise than as endings of names (x_mm,z_um).
bool is_stylus_text(std::string_view text);

// Whether its lines are single numbers with decimal commas, below header lines without commas.
bool is_decimal_comma_column(std::string_view text);

// Heights from such a text: any header lines; then rows of z, of x and z, or of x, y and z. The last cell may be
// missing: empty or a word for it (text_cells.h). Decimal commas and points both count; commas part the cells where a
// header line has units between them. The units are those of the last header line that has one for each column (as
// "z [µm]", "mm;µm", "x_mm"), else `config.units`, of one column `config.unit`. Profiles: x rises in steps that are
// even to a hundredth; steps without a row are missing heights. Maps: arrange_on_grid(). One column has the spacing
// `config.spacing_m`. Throws Error naming file, line and value.
Heights parse_stylus_text(std::string_view text, const std::string& name, const ReadHeightsConfig& config,
                          HeightsOrigin& origin);

// What is said of a column whose unit is not a length.
std::string not_a_length(std::string_view column, std::string_view unit);

// The unit of heights that no header states: the setting's, else µm, assumed.
ReadUnit setting_unit(const ReadHeightsConfig& config);

}  // namespace asperity
