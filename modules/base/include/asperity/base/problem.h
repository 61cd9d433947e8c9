#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace asperity {

// Data that was damaged but remained usable: what was wrong, where, and how often.
struct Problem {
  std::string kind;     // a short stable name, for example "duplicate_time"
  std::string message;  // one sentence for a person, with file and line where there is one
  std::size_t count = 1;
};

using Problems = std::vector<Problem>;

}  // namespace asperity
