#pragma once

#include <memory>

#include "asperity/studio/page.h"

namespace asperity::studio {

// The page on which recordings become profiles, and are compared (docs/studio-process.md).
std::unique_ptr<Page> make_process_page(Shared& shared);

}  // namespace asperity::studio
