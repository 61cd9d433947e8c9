#pragma once

#include <string>

namespace asperity::studio {

// A word as a shell reads it back, whatever is in it.
inline std::string shell_quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace asperity::studio
