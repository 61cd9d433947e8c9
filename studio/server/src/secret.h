#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace asperity::studio {

// 128 bits of the system's randomness as 32 hexadecimal digits. Throws Error if the system has none.
std::string random_secret();

// Takes as long for a first digit that differs as for the last.
bool same_secret(std::string_view given, std::string_view secret);

// The value of a cookie in a Cookie header; none if it is not there, or there twice.
std::optional<std::string_view> cookie_value(std::string_view header, std::string_view name);

}  // namespace asperity::studio
