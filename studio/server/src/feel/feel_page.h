#pragma once

#include <memory>

#include "asperity/studio/page.h"

namespace asperity::studio {

std::unique_ptr<Page> make_feel_page(Shared& shared);

}  // namespace asperity::studio
