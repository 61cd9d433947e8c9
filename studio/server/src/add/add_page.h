#pragma once

#include <memory>

#include "asperity/studio/page.h"

namespace asperity::studio {

// Files that come into the project by a browser (docs/studio-adding.md): as they are, and tables of other programs as
// recordings.
std::unique_ptr<Page> make_add_page(Shared& shared);

}  // namespace asperity::studio
