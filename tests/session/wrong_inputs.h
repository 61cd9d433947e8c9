#pragma once

#include <functional>
#include <string>
#include <vector>

#include "asperity/recording/recording.h"

namespace asperity {

// One thing wrong with an otherwise good recording.
struct WrongInput {
  std::string group;  // "tracker", "accelerometer", …
  std::string what;   // in words, as in docs/verdicts-wrong-inputs.md
  std::function<Recording()> make;
};

// Recordings of the bench with one thing wrong each; the truth is taken out.
std::vector<WrongInput> wrong_inputs(const std::string& surface, const std::string& probe, int seed);

}  // namespace asperity
