#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "../src/sdl_headers.h"

namespace asperity {

// SDL's disk driver while this lives: what would be heard is in a file, as floats, at about the clock's pace. The
// driver sleeps a whole number of milliseconds a block: blocks of 240 samples at 48 kHz make 5.
class DiskAudio {
 public:
  static constexpr int kBlock = 240;

  explicit DiskAudio(std::filesystem::path path) : path_(std::move(path)) {
    SDL_LogSetPriority(SDL_LOG_CATEGORY_AUDIO, SDL_NUM_LOG_PRIORITIES);  // it calls itself critical
    ::setenv("SDL_DISKAUDIOFILE", path_.c_str(), 1);
  }
  ~DiskAudio() { ::unsetenv("SDL_DISKAUDIOFILE"); }
  DiskAudio(const DiskAudio&) = delete;
  DiskAudio& operator=(const DiskAudio&) = delete;

  std::vector<double> samples() const {
    std::ifstream file(path_, std::ios::binary);
    std::vector<double> result;
    for (float x = 0.0F; file.read(reinterpret_cast<char*>(&x), sizeof x);) result.push_back(static_cast<double>(x));
    return result;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace asperity
