#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace asperity::testkit {

// libjpeg's own writing of width·height levels of gray, row by row from the top.
std::vector<unsigned char> encode_jpeg(int width, int height, std::span<const std::uint8_t> pixels, int quality = 95);

}  // namespace asperity::testkit
