#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/studio/block.h"

namespace asperity::studio {

// The block in a report.html that was made of exactly this result.json: it holds what no other file does, such as the
// windows of the compliance. Nothing if there exists no such file, or no block in it.
std::optional<std::string> kept_block(const std::filesystem::path& report, const Json& result);

// The numbers of a block's array of type f64; empty where it has none of that name, or is damaged.
std::vector<double> block_numbers(const std::string& block, std::string_view array);

}  // namespace asperity::studio
