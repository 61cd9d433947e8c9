#include "sdl_subsystem.h"
#include "sdl_functions.h"

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
  sdl().SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  sdl().SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  const bool audio = flag == SDL_INIT_AUDIO;
  const char* in_use = audio ? sdl().GetCurrentAudioDriver() : nullptr;
  if (in_use != nullptr && !audio_driver.empty() && audio_driver != in_use) {
    throw Error("audio: driver '" + printable(audio_driver) + "' was asked for, but '" + in_use + "' is in use");
  }
  if (audio) sdl().SetHint(SDL_HINT_AUDIODRIVER, audio_driver.empty() ? nullptr : audio_driver.c_str());
  if (sdl().InitSubSystem(flag) != 0) {
    throw Error(std::string(audio ? "audio: no driver" : "gamepad: SDL") +
                (audio_driver.empty() ? "" : " '" + printable(audio_driver) + "'") + ": " + sdl_error());
  }
}

SdlSubsystem::~SdlSubsystem() {
  const std::lock_guard lock(sdl_mutex());
  sdl().QuitSubSystem(flag_);
}

std::string sdl_error() { return printable(sdl().GetError(), 200); }

}  // namespace asperity
