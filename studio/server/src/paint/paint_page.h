#pragma once

#include <memory>

#include "asperity/studio/page.h"

namespace asperity::studio {

// The page on which textures are painted onto meshes, swapped and exported (docs/studio-paint.md).
std::unique_ptr<Page> make_paint_page(Shared& shared);

}  // namespace asperity::studio
