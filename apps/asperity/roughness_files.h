#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "roughness_of.h"

namespace asperity::app {

// A file that could not be measured, and why.
struct RoughnessFailure {
  std::string file, message;
};

// A row a file and a column a value, with _stderr where one is known: `file`, `kind`, then the values as JSON names
// them (SI units), those of a profile's P, R and W too. Cells of values that a file does not have are empty,
// those of values that are not determined nan.
std::string roughness_csv(const std::vector<RoughnessFound>& found);
inline constexpr std::string_view kRoughnessCsvBegin = "file,kind,";

// One page of its own, without scripts: of each file what the command prints and its plots, then the failures.
std::string roughness_html(const std::vector<RoughnessFound>& found, const std::vector<RoughnessFailure>& failed);
inline constexpr std::string_view kRoughnessHtmlBegin = "<!doctype html>\n<!-- asperity roughness -->";

}  // namespace asperity::app
