#pragma once

#include <filesystem>
#include <memory>

#include "asperity/studio/page.h"

namespace asperity::studio {

// The page that a newcomer sees first (docs/studio.md): recent projects and the sample project. `recent` is the user's
// list of projects (recent_projects.h); empty: none is kept.
std::unique_ptr<Page> make_home_page(Shared& shared, const std::filesystem::path& recent);

}  // namespace asperity::studio
