#pragma once

#include <string>
#include <string_view>

#include "asperity/profile/read_heights.h"

namespace asperity {

// Whether a text is a table separated by semicolons or tabs: its first row of numbers has one of them, or one of its
// first lines has and its numbers have decimal commas.
bool is_stylus_text(std::string_view text);

// Heights from such a text: any header lines; then rows of z, of x and z, or of x, y and z (a full grid). A row may
// lack its last cell: a missing height. Lines after the rows end them. Decimal commas and points both count. The units
// are those that the last header line with one for each column states (as "z [µm]", "mm;µm", "x_mm"); of one column
// without, `config.unit`; positions must state theirs. Spacing from x, which must be even to a hundredth of a step,
// else `config.spacing_m`. Throws Error naming file, line and value.
Heights parse_stylus_text(std::string_view text, const std::string& name, const ReadHeightsConfig& config);

}  // namespace asperity
