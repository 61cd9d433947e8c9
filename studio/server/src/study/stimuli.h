#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asperity/studio/project.h"
#include "asperity/study/study.h"
#include "asperity/texture/texture.h"

namespace asperity::studio {

// The textures of a study, both in the order of its names.
struct Stimuli {
  std::vector<Texture> textures;
  // CRC-32 of the bytes that each was read from: the file, then the one that a *.texture.json names.
  std::vector<std::uint32_t> crc32;
};

// Whether a stimulus of this name is an image; else it is a *.texture.json.
bool is_image(const std::string& name);

// Not for the studio's thread. Throws Error naming the file, and for a staircase of friction on a texture without any.
Stimuli read_stimuli(const Study& study, const Project& project);

// Throws Advice naming the textures that differ from those of `logged_crc32`; without check sums nothing is compared.
void check_unchanged(const Study& study, const Stimuli& stimuli, const std::vector<std::uint32_t>& logged_crc32);

}  // namespace asperity::studio
