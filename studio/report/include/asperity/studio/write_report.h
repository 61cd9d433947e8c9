#pragma once

#include <filesystem>
#include <vector>

#include "asperity/studio/report_item.h"

namespace asperity::studio {

// Writes report.html of `items` into `folder`. Does nothing if this program was built without Node. Throws Error if
// there is not an item or the file cannot be written.
void write_report(const std::filesystem::path& folder, const std::vector<ReportItem>& items);

}  // namespace asperity::studio
