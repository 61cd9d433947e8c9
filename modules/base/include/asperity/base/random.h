#pragma once

#include <array>
#include <cstdint>

namespace asperity {

// xoshiro256** (Blackman and Vigna, 2018) with its own normal deviates, so that a seed gives the
// same numbers with every standard library.
class Random {
 public:
  // Streams of one seed are independent: give each consumer its own.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  std::uint64_t bits();
  double uniform();                         // [0, 1)
  double uniform(double low, double high);  // [low, high)
  double normal();                          // mean 0, standard deviation 1
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace asperity
