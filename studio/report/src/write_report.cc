#include "asperity/studio/write_report.h"

#include "asperity/base/output.h"
#include "asperity/studio/format_report.h"
#include "asperity/web/assets.h"

namespace asperity::studio {

void write_report(const std::filesystem::path& folder, const std::vector<ReportItem>& items) {
  if (web::built()) write_file(folder / "report.html", format_report(items));
}

}  // namespace asperity::studio
