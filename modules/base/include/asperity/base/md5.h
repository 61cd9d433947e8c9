#pragma once

#include <string>
#include <string_view>

namespace asperity {

// The MD5 sum (RFC 1321) as 32 hexadecimal digits. A check against damage, not against malice.
std::string md5_hex(std::string_view data);

}  // namespace asperity
