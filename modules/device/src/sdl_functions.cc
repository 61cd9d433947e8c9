#include "sdl_functions.h"

#include "asperity/base/error.h"
#include "asperity/base/load_library.h"

namespace asperity {

namespace {

const SdlFunctions& load_sdl() {
  const SdlFunctions* (*entry)() = nullptr;
  load_library("audio and gamepads: SDL's part of this program", own_library_paths("libasperity_sdl.so"),
               {library_symbol("asperity_sdl", entry)});
  const SdlFunctions* const table = entry();
  if (table->version != kSdlFunctionsVersion) {
    throw Error("audio and gamepads: libasperity_sdl.so is of another version than this program; install both again");
  }
  return *table;
}

}  // namespace

const SdlFunctions& sdl() {
  static const SdlFunctions& table = load_sdl();
  return table;
}

}  // namespace asperity
