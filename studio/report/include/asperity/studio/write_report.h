#pragma once

#include <filesystem>

namespace asperity::studio {

// Writes report.html into `folder`, of all results at and below it (find_results). Does nothing if this program was
// built without Node. Throws Error as read_report_item does, and if the file cannot be written.
void write_report(const std::filesystem::path& folder);

}  // namespace asperity::studio
