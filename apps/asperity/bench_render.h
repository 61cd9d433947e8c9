#pragma once

#include "asperity/json/json.h"
#include "asperity/scene/scene.h"

namespace asperity::app {

// A sphere of 50 mm radius with bumps, 69,620 triangles, a Fourier texture of 128 harmonics all over it, and friction.
Scene make_render_bench();

// Times render_step on this machine: a tip is led over the first object in a random walk at 100 mm/s, 1 mm under the
// surface, 1000 times a second. Sets "triangles", "steps" and "figures": updates a second over all steps, and the
// time of single steps at 50 and 99 %, with that of reading the clock.
void time_rendering(const Scene& scene, double tip_radius_m, Json& out);

}  // namespace asperity::app
