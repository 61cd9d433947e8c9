#pragma once

#include <optional>
#include <string_view>

namespace asperity::web {

// A file of the app, embedded in the program.
struct Asset {
  std::string_view content;  // gzip if `compressed`
  std::string_view content_type;
  bool compressed = false;
};

// False if the program was built without the app, as without Node: then there is no app and no report.
bool built();
// What was missing and what to do about it, to be followed by "and build again"; empty if built().
std::string_view why_not_built();

// The file of the app at a path such as "/index.html".
std::optional<Asset> find_asset(std::string_view path);

// Script and style of report.html, uncompressed; empty if not built().
std::string_view report_script();
std::string_view report_style();

}  // namespace asperity::web
