#pragma once

namespace asperity {

inline constexpr const char* kVersion = "0.1.0";
inline constexpr const char* kVersionDate = "2026-11-22";  // as the manual page states it

}  // namespace asperity
