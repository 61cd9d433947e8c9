#pragma once

#include <optional>

namespace asperity {

// One question: which textures lie where.
struct Trial {
  int number = 1;                 // from 1
  int repetition = 1;             // from 1
  int track = 0;                  // of a staircase, from 1; 0: none
  int left = 0;                   // index of a stimulus
  int right = -1;                 // -1: there is one tile alone
  std::optional<double> level;    // of a staircase
  bool comparison_right = false;  // the side of the changed one

  bool operator==(const Trial&) const = default;
};

}  // namespace asperity
