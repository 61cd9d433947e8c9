#pragma once

#include <memory>

#include "asperity/studio/page.h"

namespace asperity::studio {

// What belongs to the project as a whole: the document's section "project" (project_setup.h) and the call "mesh.info".
std::unique_ptr<Page> make_setup_page(Shared& shared);

}  // namespace asperity::studio
