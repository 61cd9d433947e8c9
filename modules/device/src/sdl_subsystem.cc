#include "sdl_subsystem.h"

#include <mutex>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

// SDL counts users of a subsystem without a lock.
std::mutex& sdl_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

SdlSubsystem::SdlSubsystem(Uint32 flag, const std::string& audio_driver) : flag_(flag) {
  const std::lock_guard lock(sdl_mutex());
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  const bool audio = flag == SDL_INIT_AUDIO;
  const char* in_use = audio ? SDL_GetCurrentAudioDriver() : nullptr;
  if (in_use != nullptr && !audio_driver.empty() && audio_driver != in_use) {
    throw Error("audio: driver '" + printable(audio_driver) + "' wanted, but '" + in_use + "' is in use");
  }
  if (audio) SDL_SetHint(SDL_HINT_AUDIODRIVER, audio_driver.empty() ? nullptr : audio_driver.c_str());
  if (SDL_InitSubSystem(flag) != 0) {
    throw Error(std::string(audio ? "audio: no driver" : "gamepad: SDL") +
                (audio_driver.empty() ? "" : " '" + printable(audio_driver) + "'") + ": " + sdl_error());
  }
}

SdlSubsystem::~SdlSubsystem() {
  const std::lock_guard lock(sdl_mutex());
  SDL_QuitSubSystem(flag_);
}

std::string sdl_error() { return printable(SDL_GetError(), 200); }

}  // namespace asperity
