#pragma once

#include <string>
#include <vector>

#include "asperity/studio/report_item.h"

namespace asperity::studio {

// report.html: one file with script, style and data in it, which a browser shows without a network (docs/report.md).
// The same items give the same bytes. Throws Error without an item, or if this program was built without Node
// (web::built()).
std::string format_report(const std::vector<ReportItem>& items);

}  // namespace asperity::studio
