#include "asperity/image/png_image.h"

#include <png.h>
#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

// libpng reports errors by a function that must not return; the text is kept for the Error.
struct PngFault {
  char text[200] = "";
};

[[noreturn]] void on_png_error(png_structp png, png_const_charp message) {
  auto* fault = static_cast<PngFault*>(png_get_error_ptr(png));
  std::strncpy(fault->text, message, sizeof fault->text - 1);
  png_longjmp(png, 1);
}

void on_png_warning(png_structp, png_const_charp) {}

struct PngBytes {
  std::string_view rest;
};

void take_png_bytes(png_structp png, png_bytep to, png_size_t count) {
  auto* source = static_cast<PngBytes*>(png_get_io_ptr(png));
  if (count > source->rest.size()) png_error(png, "the file is cut off");
  std::memcpy(to, source->rest.data(), count);
  source->rest.remove_prefix(count);
}

void give_png_bytes(png_structp png, png_bytep from, png_size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(from), count);
}

void flush_nothing(png_structp) {}

std::string image_size_text(std::size_t width, std::size_t height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

template <class Size>
bool image_size_fits(Size width, Size height) {
  constexpr auto kMost = static_cast<Size>(kLargestImageSide_px);
  return width > 0 && height > 0 && width <= kMost && height <= kMost;
}

struct PngHeader {
  png_uint_32 width = 0, height = 0;
  int bits = 0, colour = 0;
};

// Nothing that has a destructor is made between setjmp and the calls that may jump.
bool read_png_header(png_structp png, png_infop info, PngHeader& header) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, kLargestImageSide_px, kLargestImageSide_px);
  png_set_chunk_cache_max(png, 64);
  png_set_chunk_malloc_max(png, 1 << 20);
  png_read_info(png, info);
  png_get_IHDR(png, info, &header.width, &header.height, &header.bits, &header.colour, nullptr, nullptr, nullptr);
  return true;
}

enum class PngDepth { kEight, kAsItIs };

// As samples of gray whatever the file has, of 8 bits, or of 16 where it has 16 and these are kept.
bool convert_to_gray(png_structp png, const PngHeader& header, PngDepth depth) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  if (depth == PngDepth::kEight) png_set_strip_16(png);
  png_set_strip_alpha(png);
  if (header.colour == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
  if ((header.colour & PNG_COLOR_MASK_COLOR) == 0 && header.bits < 8) png_set_expand_gray_1_2_4_to_8(png);
  constexpr int kSilently = 1;
  png_set_rgb_to_gray(png, kSilently, 0.299, 0.587);
  return true;
}

bool read_png_rows(png_structp png, png_infop info, std::size_t row_bytes, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) != row_bytes) png_error(png, "its rows have another length");
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

enum class PngEffort { kSmall, kFast };

bool write_png_parts(png_structp png, png_infop info, const PngHeader& header, PngEffort effort, png_bytepp data) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_compression_level(png, effort == PngEffort::kFast ? 1 : 6);
  constexpr int kDefaultStrategy = 0;  // zlib's
  if (effort == PngEffort::kFast) png_set_compression_strategy(png, kDefaultStrategy);
  png_set_IHDR(png, info, header.width, header.height, header.bits, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
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
  PngFault fault;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &fault, on_png_error, on_png_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct PngWriter {
  PngFault fault;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &fault, on_png_error, on_png_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

// A file whose header was read and may be believed.
class PngSource {
 public:
  // `damaged` begins what is said of a file that libpng does not read.
  PngSource(std::string_view data, const std::string& name, const char* damaged)
      : name_(name), damaged_(damaged), source_{data} {
    if (data.size() < 8 || png_sig_cmp(reinterpret_cast<png_const_bytep>(data.data()), 0, 8) != 0)
      fail("is not a PNG image");
    if (!reader_.info) fail("libpng cannot be started");
    png_set_read_fn(reader_.png, &source_, take_png_bytes);
    if (!read_png_header(reader_.png, reader_.info, header_)) broken();
    if (!image_size_fits(header_.width, header_.height))
      fail(image_size_text(header_.width, header_.height) + " are too many");
    // Deflate makes at most 1032 bytes of one: what cannot be there takes no memory.
    constexpr std::size_t kMostBytesOfOne = 1032;
    const std::size_t row_bytes = png_get_rowbytes(reader_.png, reader_.info);
    cut_off_ = row_bytes * header_.height / kMostBytesOfOne > data.size();
  }

  const PngHeader& header() const { return header_; }
  [[noreturn]] void fail(const std::string& message) const { throw Error(name_ + ": " + message); }

  void to_gray(PngDepth depth) {
    if (!convert_to_gray(reader_.png, header_, depth)) broken();
  }

  // Rows of `row_bytes` after what conversion was asked for.
  std::vector<png_byte> read(std::size_t row_bytes) {
    if (cut_off_) fail("is cut off: " + image_size_text(header_.width, header_.height) + " do not fit");
    std::vector<png_byte> bytes(row_bytes * header_.height);
    auto pointers = row_pointers(bytes, header_.height, row_bytes);
    if (!read_png_rows(reader_.png, reader_.info, row_bytes, pointers.data())) broken();
    return bytes;
  }

 private:
  [[noreturn]] void broken() const { fail(damaged_ + printable(reader_.fault.text, 200)); }

  const std::string& name_;
  std::string damaged_;
  PngBytes source_;
  PngReader reader_;
  PngHeader header_;
  bool cut_off_ = false;
};

std::string write_png(std::vector<png_byte>& bytes, const PngHeader& header, PngEffort effort) {
  auto pointers = row_pointers(bytes, header.height, bytes.size() / header.height);
  std::string out;
  PngWriter writer;
  if (!writer.info) throw Error("image: libpng cannot be started");
  png_set_write_fn(writer.png, &out, give_png_bytes, flush_nothing);
  if (!write_png_parts(writer.png, writer.info, header, effort, pointers.data())) {
    throw Error("image: a PNG cannot be written: " + printable(writer.fault.text, 200));
  }
  return out;
}

template <class Sample>
PngHeader checked_header(const BasicGrayImage<Sample>& image) {
  if (!image_size_fits(image.width, image.height) ||
      image.pixels.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
    throw Error("image: " + std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels with " +
                std::to_string(image.pixels.size()) + " samples cannot be written");
  }
  if (image.bits != 8 && image.bits != 8 * static_cast<int>(sizeof(Sample)))
    throw Error("image: " + std::to_string(image.bits) + " bits; 8 or 16 are possible");
  PngHeader header;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.bits = image.bits;
  return header;
}

}  // namespace

namespace {

// Samples of 8 or 16 bits in gray, big endian as PNG has them.
DeepGrayImage read_levels(PngSource& source, int bits) {
  const PngHeader& header = source.header();
  DeepGrayImage image;
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  image.bits = bits;
  const std::vector<png_byte> bytes = source.read(std::size_t{header.width} * static_cast<unsigned>(bits / 8));
  image.pixels.resize(std::size_t{header.width} * header.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = bits == 8 ? bytes[i] : static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]);
  return image;
}

}  // namespace

DeepGrayImage parse_png(std::string_view data, const std::string& name) {
  PngSource source(data, name, "a damaged PNG image: ");
  const PngHeader& header = source.header();
  if (header.colour != PNG_COLOR_TYPE_GRAY || (header.bits != 8 && header.bits != 16))
    source.fail("not an image of 8 or 16 bit grey without transparency");
  return read_levels(source, header.bits);
}

DeepGrayImage convert_png(std::string_view data, const std::string& name, std::string& note) {
  PngSource source(data, name, "a damaged PNG image: ");
  const PngHeader& header = source.header();
  note.clear();
  const auto add = [&note](const std::string& what) { note += (note.empty() ? "" : ", ") + what; };
  if (header.colour == PNG_COLOR_TYPE_PALETTE) add("a palette");
  if (header.colour == PNG_COLOR_TYPE_RGB || header.colour == PNG_COLOR_TYPE_RGB_ALPHA) add("colours");
  if (header.colour == PNG_COLOR_TYPE_GRAY && header.bits < 8) add(std::to_string(header.bits) + " bits");
  if ((header.colour & PNG_COLOR_MASK_ALPHA) != 0) add("transparency, which is left out");
  if (note.empty()) return read_levels(source, header.bits);
  source.to_gray(PngDepth::kAsItIs);
  return read_levels(source, header.bits == 16 ? 16 : 8);
}

GrayImage decode_png(std::string_view data, const std::string& name) {
  PngSource source(data, name, "the image is damaged: ");
  source.to_gray(PngDepth::kEight);
  GrayImage image;
  image.width = static_cast<int>(source.header().width);
  image.height = static_cast<int>(source.header().height);
  image.pixels = source.read(source.header().width);
  return image;
}

std::string format_png(const DeepGrayImage& image) {
  const PngHeader header = checked_header(image);
  const auto highest = *std::max_element(image.pixels.begin(), image.pixels.end());
  if (image.bits == 8 && highest > 255) throw Error("image: the level " + std::to_string(highest) + " exceeds 8 bits");
  std::vector<png_byte> bytes;
  bytes.reserve(image.pixels.size() * static_cast<std::size_t>(image.bits / 8));
  for (const std::uint16_t level : image.pixels) {
    if (image.bits == 16) bytes.push_back(static_cast<png_byte>(level >> 8));
    bytes.push_back(static_cast<png_byte>(level & 0xFF));
  }
  return write_png(bytes, header, PngEffort::kSmall);
}

std::string format_png(const GrayImage& image) {
  const PngHeader header = checked_header(image);
  std::vector<png_byte> bytes = image.pixels;
  return write_png(bytes, header, PngEffort::kFast);
}

namespace {

std::string write_png_image(int width, int height, std::size_t samples, png_uint_32 format, const void* data) {
  if (!image_size_fits(width, height) ||
      samples != 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw Error("image: " + std::to_string(width) + " x " + std::to_string(height) + " pixels with " +
                std::to_string(samples) + " samples cannot be written in colours");
  }
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  png_alloc_size_t size = 0;
  std::string out;
  if (png_image_write_to_memory(&image, nullptr, &size, 0, data, 0, nullptr) != 0) {
    out.resize(size);
    if (png_image_write_to_memory(&image, out.data(), &size, 0, data, 0, nullptr) != 0) {
      out.resize(size);
      return out;
    }
  }
  throw Error(std::string("image: libpng: ") + image.message);
}

}  // namespace

std::string format_rgb_png(int width, int height, std::span<const std::uint16_t> samples) {
  return write_png_image(width, height, samples.size(), PNG_FORMAT_LINEAR_RGB, samples.data());
}

std::string format_colour_png(int width, int height, std::span<const std::uint8_t> samples) {
  return write_png_image(width, height, samples.size(), PNG_FORMAT_RGB, samples.data());
}

}  // namespace asperity
