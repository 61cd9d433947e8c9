#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "asperity/study/study.h"
#include "asperity/texture/texture.h"

namespace asperity {

// The textures of a study, both in the order of its names.
struct Stimuli {
  std::vector<Texture> textures;
  // CRC-32 of the bytes that each was read from: the file, then the one that a *.texture.json names.
  std::vector<std::uint32_t> crc32;
};

// Whether a stimulus of this name is an image; else it is a *.texture.json.
bool is_image(const std::string& name);

// Reads files, of up to a gigabyte. `find` gives the file of a stimulus by its name. Throws Error naming the file, and
// StudyError (kNoFriction) for a staircase of friction on a texture without any.
Stimuli read_stimuli(const Study& study, const std::function<std::filesystem::path(const std::string&)>& find);

// Throws StudyError (kTexturesChanged) naming the textures that differ from those of `logged_crc32`; without check sums
// nothing is compared.
void check_unchanged(const Study& study, const Stimuli& stimuli, const std::vector<std::uint32_t>& logged_crc32);

}  // namespace asperity
