#pragma once

#include <string>

namespace asperity {

// "2000-01-01T00:00:00Z": when a recording was made.
std::string utc_now();

}  // namespace asperity
