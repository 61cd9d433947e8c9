#pragma once

#include <string>
#include <vector>

namespace asperity::studio {

// A row of the table of limits in docs/studio-safety.md.
struct LimitRow {
  std::string what, limit, beyond;
  std::vector<std::string> tests;  // of studio_test, "Suite.Name"
};

// All limits of the server, from the constants that it works by.
std::vector<LimitRow> limit_rows();

// The same as a table in Markdown.
std::string limit_table();

}  // namespace asperity::studio
