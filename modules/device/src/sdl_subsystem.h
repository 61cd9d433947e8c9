#pragma once

#include <string>

#include "sdl_headers.h"

namespace asperity {

// A part of SDL that is in use while this lives. The process's signal handlers stay as they are.
class SdlSubsystem {
 public:
  // `audio_driver`: for SDL_INIT_AUDIO, by SDL's name; empty: SDL's choice. Throws Error in SDL's words, or if audio
  // is in use with another driver.
  explicit SdlSubsystem(Uint32 flag, const std::string& audio_driver = {});
  ~SdlSubsystem();
  SdlSubsystem(const SdlSubsystem&) = delete;
  SdlSubsystem& operator=(const SdlSubsystem&) = delete;

 private:
  Uint32 flag_;
};

// SDL's last error, printable.
std::string sdl_error();

}  // namespace asperity
