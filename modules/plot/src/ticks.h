#pragma once

#include <string>
#include <utility>
#include <vector>

namespace asperity {

struct Tick {
  double value;
  std::string label;  // empty: a line alone
};

// Multiples of 1, 2 or 5 times a power of ten in [low, high], at most some `most` of them.
std::vector<Tick> linear_ticks(double low, double high, int most);

// The powers of ten in [low, high], some of them without a label where there are more than `most`; the linear ones if
// there are fewer than two. 0 < low < high.
std::vector<Tick> decade_ticks(double low, double high, int most);

}  // namespace asperity
