#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "asperity/studio/block.h"

namespace asperity::studio {

// The block in a report.html that was made of exactly this result.json: it holds what no other file does, such as the
// windows of the compliance. Nothing if there is no such file, or none such in it.
std::optional<std::string> kept_block(const std::filesystem::path& report, const Json& result);

}  // namespace asperity::studio
