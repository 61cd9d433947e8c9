#pragma once

// SDL renames main() otherwise.
#define SDL_MAIN_HANDLED
#include <SDL.h>
