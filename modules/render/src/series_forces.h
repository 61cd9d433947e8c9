#pragma once

#include "asperity/render/texture_force.h"

namespace asperity {

// The forces of the models that have no place but a past. The tangential part opposes the motion while the normal one
// pushes the tip out, as friction does (erratum 19). Realtime-safe: yes.

// k Δh n − ρ k (H − lift) v̂, v̂ along the motion, H the next height of the grains, Δh = clamp(H − z, 0, H): grains above
// the mean brake and those below it yield (Siira and Pai 1996, whose ρ approximates Coulomb friction; erratum 27).
TextureForce stochastic_force(const RenderTexture& texture, SeriesState& series, const TextureTouch& touch) noexcept;

// The tool's vibration as a force of mean zero, no stronger than the load that carries it (Romano and Kuchenbecker
// 2012).
TextureForce autoregressive_force(const RenderTexture& texture, SeriesState& series,
                                  const TextureTouch& touch) noexcept;

// The tool's ringing; `new_contact` begins a tap with the speed of approach (Okamura, Dennerlein and Howe 1998).
TextureForce ringing_force(const RenderTexture& texture, SeriesState& series, const TextureTouch& touch,
                           bool new_contact) noexcept;

}  // namespace asperity
