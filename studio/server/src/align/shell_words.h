#pragma once

#include <string>

namespace asperity::studio {

// A word quoted for a shell.
inline std::string shell_quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace asperity::studio
