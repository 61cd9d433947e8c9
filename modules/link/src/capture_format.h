#pragma once

#include <filesystem>
#include <string_view>

namespace asperity {

// Beside a file of captured bytes lies when they came: how many, and when on the clock of the capturing host.
inline std::filesystem::path arrivals_path(const std::filesystem::path& capture) {
  return capture.string() + ".arrivals.csv";
}
inline constexpr std::string_view kArrivalsHeader = "bytes,arrival_ns\n";

}  // namespace asperity
