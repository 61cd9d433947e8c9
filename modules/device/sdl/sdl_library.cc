// libasperity_sdl.so: all that is SDL's.
#include "sdl_functions.h"

extern "C" const asperity::SdlFunctions* asperity_sdl() {
  static const asperity::SdlFunctions table{asperity::kSdlFunctionsVersion,
                                            SDL_SetHint,
                                            SDL_InitSubSystem,
                                            SDL_QuitSubSystem,
                                            SDL_GetError,
                                            SDL_TLSCleanup,
                                            SDL_GetCurrentAudioDriver,
                                            SDL_OpenAudioDevice,
                                            SDL_PauseAudioDevice,
                                            SDL_GetAudioDeviceStatus,
                                            SDL_CloseAudioDevice,
                                            SDL_NumJoysticks,
                                            SDL_JoystickNameForIndex,
                                            SDL_JoystickOpen,
                                            SDL_JoystickClose,
                                            SDL_JoystickHasRumble,
                                            SDL_JoystickRumble,
                                            SDL_JoystickUpdate,
                                            SDL_JoystickGetAttached};
  return &table;
}
