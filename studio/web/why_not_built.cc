#include "asperity/web/assets.h"

namespace asperity::web {

std::string_view why_not_built() { return ASPERITY_WHY; }

}  // namespace asperity::web
