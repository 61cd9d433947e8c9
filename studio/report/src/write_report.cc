#include "asperity/studio/write_report.h"

#include <vector>

#include "asperity/base/output.h"
#include "asperity/studio/format_report.h"
#include "asperity/studio/read_report_item.h"
#include "asperity/web/assets.h"

namespace asperity::studio {

void write_report(const std::filesystem::path& folder) {
  if (!web::built()) return;
  std::vector<ReportItem> items;
  for (const std::filesystem::path& result : find_results(folder)) items.push_back(read_report_item(result));
  write_file(folder / "report.html", format_report(items));
}

}  // namespace asperity::studio
