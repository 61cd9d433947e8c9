#pragma once

#include <string>

namespace asperity {

// Which processes have `path` open, for messages: "process 812 (picocom)"; empty if that cannot be seen.
std::string file_holders(const std::string& path);

}  // namespace asperity
