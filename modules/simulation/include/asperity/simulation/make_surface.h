#pragma once

#include <cstdint>
#include <memory>

#include "asperity/base/problem.h"
#include "asperity/simulation/surface.h"
#include "asperity/simulation/surface_config.h"

namespace asperity {

// The relief that `config` describes; stochastic ones are drawn from `seed`. Nominal levels: the mean of
// sine, sandpaper, clay pot and file; the face of a protoboard; the tops of a cable tie's teeth.
// Only the kind `file` reads one: see load_surface.h. Throws Error for a band or opening turned inside
// out and for a bad file; damage that leaves it readable is added to `problems`.
std::unique_ptr<Surface> make_surface(const SimulatedSurfaceConfig& config, std::uint64_t seed,
                                      Problems* problems = nullptr);

}  // namespace asperity
