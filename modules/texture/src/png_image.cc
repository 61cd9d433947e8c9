#include "asperity/texture/png_image.h"

#include <png.h>
#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

// libpng reports errors by a function that must not return; the text is kept for the Error.
struct Fault {
  char text[200] = "";
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* fault = static_cast<Fault*>(png_get_error_ptr(png));
  std::strncpy(fault->text, message, sizeof fault->text - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

struct Source {
  std::string_view rest;
};

void read_bytes(png_structp png, png_bytep to, png_size_t count) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (count > source->rest.size()) png_error(png, "the file is cut off");
  std::memcpy(to, source->rest.data(), count);
  source->rest.remove_prefix(count);
}

void write_bytes(png_structp png, png_bytep from, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(from), count);
}

void flush_nothing(png_structp) {}

std::string size_text(std::size_t columns, std::size_t rows) {
  return std::to_string(columns) + " x " + std::to_string(rows) + " pixels";
}

bool size_fits(std::size_t columns, std::size_t rows) {
  return columns > 0 && rows > 0 && columns <= kMostPixelsASide && rows <= kMostPixelsASide &&
         columns * rows <= kMostPixels;
}

// Nothing that has a destructor is made between setjmp and the calls that may jump.
bool read_header(png_structp png, png_infop info, png_uint_32& columns, png_uint_32& rows, int& bits, int& colour) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, kMostPixelsASide, kMostPixelsASide);
  png_set_chunk_cache_max(png, 64);
  png_set_chunk_malloc_max(png, 1 << 20);
  png_read_info(png, info);
  png_get_IHDR(png, info, &columns, &rows, &bits, &colour, nullptr, nullptr, nullptr);
  return true;
}

bool read_rows(png_structp png, png_infop info, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

bool write_all(png_structp png, png_infop info, png_uint_32 columns, png_uint_32 rows, int bits, png_bytepp data) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_compression_level(png, 6);
  png_set_IHDR(png, info, columns, rows, bits, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
               PNG_FILTER_TYPE_BASE);
  png_write_info(png, info);
  png_write_image(png, data);
  png_write_end(png, nullptr);
  return true;
}

std::vector<png_bytep> row_pointers(std::vector<png_byte>& bytes, std::size_t rows, std::size_t row_bytes) {
  std::vector<png_bytep> pointers(rows);
  for (std::size_t r = 0; r < rows; ++r) pointers[r] = bytes.data() + r * row_bytes;
  return pointers;
}

struct PngReader {
  Fault fault;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &fault, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct Writer {
  Fault fault;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &fault, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

}  // namespace

GreyImage parse_png(std::string_view data, const std::string& name) {
  const auto fail = [&name](const std::string& message) { throw Error(name + ": " + message); };
  if (data.size() < 8 || png_sig_cmp(reinterpret_cast<png_const_bytep>(data.data()), 0, 8) != 0)
    fail("is not a PNG image");
  PngReader reader;
  if (!reader.info) fail("libpng cannot be started");
  Source source{data};
  png_set_read_fn(reader.png, &source, read_bytes);
  const auto broken = [&] { fail("a damaged PNG image: " + printable(reader.fault.text, 200)); };
  png_uint_32 columns = 0;
  png_uint_32 rows = 0;
  int bits = 0;
  int colour = 0;
  if (!read_header(reader.png, reader.info, columns, rows, bits, colour)) broken();
  if (!size_fits(columns, rows)) fail(size_text(columns, rows) + " are too many");
  if (colour != PNG_COLOR_TYPE_GRAY || (bits != 8 && bits != 16)) {
    fail("not an image of 8 or 16 bit grey without transparency");
  }
  GreyImage image{columns, rows, bits, {}};
  const std::size_t row_bytes = image.columns * static_cast<std::size_t>(bits / 8);
  // Deflate makes at most 1032 bytes of one: what cannot be there takes no memory.
  constexpr std::size_t kMostBytesOfOne = 1032;
  if (row_bytes * image.rows / kMostBytesOfOne > data.size())
    fail("is cut off: " + size_text(columns, rows) + " do not fit");
  std::vector<png_byte> bytes(row_bytes * image.rows);
  auto pointers = row_pointers(bytes, image.rows, row_bytes);
  if (!read_rows(reader.png, reader.info, pointers.data())) broken();
  image.level.resize(image.columns * image.rows);
  for (std::size_t i = 0; i < image.level.size(); ++i) {
    image.level[i] = bits == 8 ? bytes[i] : static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]);
  }
  return image;
}

std::string format_png(const GreyImage& image) {
  if (!size_fits(image.columns, image.rows) || image.level.size() != image.columns * image.rows)
    throw Error("texture: an image of " + size_text(image.columns, image.rows) + " with " +
                std::to_string(image.level.size()) + " samples cannot be written");
  if (image.bits != 8 && image.bits != 16)
    throw Error("texture: an image of " + std::to_string(image.bits) + " bits; 8 or 16 are possible");
  const auto highest = *std::max_element(image.level.begin(), image.level.end());
  if (image.bits == 8 && highest > 255)
    throw Error("texture: the level " + std::to_string(highest) + " exceeds 8 bits");
  const std::size_t row_bytes = image.columns * static_cast<std::size_t>(image.bits / 8);
  std::vector<png_byte> bytes;
  bytes.reserve(row_bytes * image.rows);
  for (const std::uint16_t level : image.level) {
    if (image.bits == 16) bytes.push_back(static_cast<png_byte>(level >> 8));
    bytes.push_back(static_cast<png_byte>(level & 0xFF));
  }
  auto pointers = row_pointers(bytes, image.rows, row_bytes);
  std::string out;
  Writer writer;
  if (!writer.info) throw Error("texture: libpng cannot be started");
  png_set_write_fn(writer.png, &out, write_bytes, flush_nothing);
  if (!write_all(writer.png, writer.info, static_cast<png_uint_32>(image.columns), static_cast<png_uint_32>(image.rows),
                 image.bits, pointers.data())) {
    throw Error("texture: the image cannot be written: " + printable(writer.fault.text, 200));
  }
  return out;
}

}  // namespace asperity
