#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "asperity/json/json.h"
#include "asperity/profile/profile.h"
#include "asperity/profile/surface_spectrum.h"

namespace asperity::studio {

inline constexpr std::uint64_t kLargestResult_bytes = 16U << 20U;
inline constexpr std::uint64_t kLargestProfile_bytes = 256U << 20U;

// A result's files from their content; `name` is what messages call them. Each throws Error naming file, line and
// value.
Json parse_result(std::string_view text, const std::string& name);
// A column that an older file does not have is nan.
Profile parse_profile(std::string_view text, const std::string& name);
SurfaceSpectrum parse_spectrum(std::string_view text, const std::string& name);

}  // namespace asperity::studio
