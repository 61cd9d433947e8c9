#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/studio/page.h"

namespace asperity::studio {

// All pages, in the order in which they hear of things. `recent` is as of StudioConfig.
std::vector<std::unique_ptr<Page>> make_pages(Shared& shared, const std::optional<std::string>& opened,
                                              const std::filesystem::path& recent);

}  // namespace asperity::studio
