#pragma once

#include <string>

namespace asperity::cli {

// A plane of 40 × 20 mm in cells of 4 mm, in millimetres.
inline std::string plane_obj() {
  std::string out;
  for (int j = 0; j <= 5; ++j) {
    for (int i = 0; i <= 10; ++i) out += "v " + std::to_string(4 * i) + " " + std::to_string(4 * j) + " 0\n";
  }
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 10; ++i) {
      const int a = 11 * j + i + 1;
      out += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 12) + " " +
             std::to_string(a + 11) + "\n";
    }
  }
  return out;
}

}  // namespace asperity::cli
