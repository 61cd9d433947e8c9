#pragma once

#include <memory>

#include "asperity/studio/page.h"

namespace asperity::studio {

// The Scan page's server side (docs/studio-scan.md).
std::unique_ptr<Page> make_scan_page(Shared& shared);

}  // namespace asperity::studio
