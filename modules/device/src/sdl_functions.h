#pragma once

#include "sdl_headers.h"

namespace asperity {

// SDL as we use it, each by its name without SDL_. It is a library of our own (libasperity_sdl.so), loaded when a
// device wants it: SDL brings along some fifty libraries of sound and of windows, which most runs of the program never
// need.
struct SdlFunctions {
  int version;  // kSdlFunctionsVersion
  decltype(&::SDL_SetHint) SetHint;
  decltype(&::SDL_InitSubSystem) InitSubSystem;
  decltype(&::SDL_QuitSubSystem) QuitSubSystem;
  decltype(&::SDL_GetError) GetError;
  decltype(&::SDL_TLSCleanup) TLSCleanup;
  decltype(&::SDL_GetCurrentAudioDriver) GetCurrentAudioDriver;
  decltype(&::SDL_OpenAudioDevice) OpenAudioDevice;
  decltype(&::SDL_PauseAudioDevice) PauseAudioDevice;
  decltype(&::SDL_GetAudioDeviceStatus) GetAudioDeviceStatus;
  decltype(&::SDL_CloseAudioDevice) CloseAudioDevice;
  decltype(&::SDL_NumJoysticks) NumJoysticks;
  decltype(&::SDL_JoystickNameForIndex) JoystickNameForIndex;
  decltype(&::SDL_JoystickOpen) JoystickOpen;
  decltype(&::SDL_JoystickClose) JoystickClose;
  decltype(&::SDL_JoystickHasRumble) JoystickHasRumble;
  decltype(&::SDL_JoystickRumble) JoystickRumble;
  decltype(&::SDL_JoystickUpdate) JoystickUpdate;
  decltype(&::SDL_JoystickGetAttached) JoystickGetAttached;
};

inline constexpr int kSdlFunctionsVersion = 1;

// Loads the library if that is not yet done. Throws Error naming the paths searched if it is missing or of another
// version; any thread.
const SdlFunctions& sdl();

}  // namespace asperity
