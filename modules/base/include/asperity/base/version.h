#pragma once

namespace asperity {

inline constexpr const char* kVersion = "0.2.0";
inline constexpr const char* kVersionDate = "2026-11-28";  // as the manual page states it

}  // namespace asperity
