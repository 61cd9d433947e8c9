#pragma once

#include <cstdint>

#include "asperity/json/json.h"
#include "asperity/texture/texture.h"

namespace asperity {

// A model's numbers, for people.
Json describe_texture_model(const TextureModel& model);

// Makes heights, or the forces of a series, `factor` times as large.
void scale_texture_model(TextureModel& model, double factor);

// Other random numbers; false for a model, or a kind of it, that has none.
bool reseed_texture_model(TextureModel& model, std::int64_t seed);

// The memory that a texture takes, about.
std::uint64_t size_bytes(const Texture& texture);

}  // namespace asperity
