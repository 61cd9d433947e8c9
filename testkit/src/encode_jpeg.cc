#include "asperity/testkit/encode_jpeg.h"

#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

namespace asperity::testkit {

std::vector<unsigned char> encode_jpeg(int width, int height, std::span<const std::uint8_t> pixels, int quality) {
  jpeg_error_mgr fault{};
  jpeg_compress_struct jpeg{};
  jpeg.err = jpeg_std_error(&fault);
  jpeg_create_compress(&jpeg);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &memory, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = 1;
  jpeg.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(width));
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    const auto from = pixels.subspan(y * row.size(), row.size());
    row.assign(from.begin(), from.end());
    JSAMPROW begin = row.data();
    jpeg_write_scanlines(&jpeg, &begin, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::vector<unsigned char> out(memory, memory + size);
  std::free(memory);
  return out;
}

}  // namespace asperity::testkit
