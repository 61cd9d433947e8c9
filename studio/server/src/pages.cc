#include "pages.h"

#include "add/add_page.h"
#include "align/align_page.h"
#include "common_page.h"
#include "feel/feel_page.h"
#include "home/home_page.h"
#include "paint/paint_page.h"
#include "process/process_page.h"
#include "scan/scan_page.h"
#include "setup/setup_page.h"
#include "study/study_page.h"

namespace asperity::studio {

std::vector<std::unique_ptr<Page>> make_pages(Shared& shared, const std::optional<std::string>& opened,
                                              const std::filesystem::path& recent) {
  std::vector<std::unique_ptr<Page>> pages;
  pages.push_back(std::make_unique<CommonPage>(shared, opened));
  pages.push_back(make_setup_page(shared));
  pages.push_back(make_home_page(shared, recent));
  pages.push_back(make_add_page(shared));
  pages.push_back(make_scan_page(shared));
  pages.push_back(make_process_page(shared));
  pages.push_back(make_align_page(shared));
  pages.push_back(make_paint_page(shared));
  auto feel = make_feel_page(shared);
  FeelPage& host = *feel;
  pages.push_back(std::move(feel));
  pages.push_back(make_study_page(shared, host));
  return pages;
}

}  // namespace asperity::studio
