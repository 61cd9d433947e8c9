// libtiff's side of tiff_library.h.
#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "tiff_library.h"

namespace asperity {

namespace {

constexpr tmsize_t kMostAtOnce_bytes = tmsize_t{1} << 30;
// What the densest of libtiff's compressions makes of one byte, with room: more cannot be there.
constexpr std::uint64_t kMostBytesOfOne = 8192;

// The bytes in memory, and the first error that libtiff reports.
struct Source {
  std::string_view bytes;
  toff_t at = 0;
  char fault[200] = "";
};

Source& source_of(thandle_t handle) { return *static_cast<Source*>(handle); }

tmsize_t take(thandle_t handle, void* to, tmsize_t size) {
  Source& source = source_of(handle);
  if (source.at >= source.bytes.size() || size < 0) return 0;
  const std::size_t count = std::min(static_cast<std::size_t>(size), source.bytes.size() - source.at);
  std::memcpy(to, source.bytes.data() + source.at, count);
  source.at += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t give_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  Source& source = source_of(handle);
  if (whence == SEEK_CUR) offset += source.at;
  if (whence == SEEK_END) offset += source.bytes.size();
  return source.at = offset;
}

int close_nothing(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return source_of(handle).bytes.size(); }

[[gnu::format(printf, 4, 0)]] int on_error(TIFF*, void* user, const char*, const char* format, va_list words) {
  auto* source = static_cast<Source*>(user);
  if (source->fault[0] == '\0') std::vsnprintf(source->fault, sizeof source->fault, format, words);
  return 1;
}

int on_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct Close {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : name_(name), source_{bytes} {
    const std::unique_ptr<TIFFOpenOptions, Close> options(TIFFOpenOptionsAlloc());
    if (!options) fail("libtiff cannot be started");
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMostAtOnce_bytes);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &source_);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, &source_);
    // m: not by mapping, which memory does not need.
    tiff_.reset(TIFFClientOpenExt("memory", "rm", &source_, take, give_nothing, seek, close_nothing, size_of, nullptr,
                                  nullptr, options.get()));
    if (!tiff_) broken();
  }

  TiffImage read() {
    TiffImage out;
    header(out);
    out.values.resize(out.columns * out.rows);
    if (TIFFIsTiled(tiff_.get()) != 0) {
      tiles(out);
    } else {
      lines(out);
    }
    for (std::size_t i = 0; i < out.values.size(); ++i) {
      if (std::isinf(out.values[i]))
        fail("the number of pixel " + std::to_string(i % out.columns + 1) + " of row " +
             std::to_string(i / out.columns + 1) + " is infinite");
    }
    refuse_further_pages();
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw Error(name_ + ": " + message); }
  [[noreturn]] void broken() const {
    fail("a damaged TIFF: " +
         (source_.fault[0] == '\0' ? std::string("it cannot be read") : printable(std::string(source_.fault), 200)));
  }

  template <class Number>
  Number field(std::uint32_t tag) const {
    Number out = 0;
    if (TIFFGetFieldDefaulted(tiff_.get(), tag, &out) == 0) out = 0;
    return out;
  }

  // Which of several pages has the heights cannot be known. Smaller copies and masks of the first are no pages.
  void refuse_further_pages() {
    constexpr int kMostCopies = 100;
    for (int i = 0; TIFFLastDirectory(tiff_.get()) == 0; ++i) {
      if (TIFFReadDirectory(tiff_.get()) == 0 || i >= kMostCopies) broken();
      const auto kind = field<std::uint32_t>(TIFFTAG_SUBFILETYPE);
      if ((kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) == 0)
        fail("has further pages; one is read: save the page with the heights by itself");
    }
  }

  void header(TiffImage& out) {
    out.columns = field<std::uint32_t>(TIFFTAG_IMAGEWIDTH);
    out.rows = field<std::uint32_t>(TIFFTAG_IMAGELENGTH);
    if (out.columns == 0 || out.rows == 0 || out.columns > kMostTiffPixels / out.rows) {
      fail("an image of " + std::to_string(out.columns) + " x " + std::to_string(out.rows) +
           " pixels is empty or too large");
    }
    const int samples = field<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL);
    if (samples != 1) fail("has " + std::to_string(samples) + " numbers a pixel; one is read");
    const int photometric = field<std::uint16_t>(TIFFTAG_PHOTOMETRIC);
    if (photometric != PHOTOMETRIC_MINISBLACK)
      fail("is of kind " + std::to_string(photometric) + " (PhotometricInterpretation); 1, black is 0, is read");
    // Lossy kinds are no heights, and libtiff fills damaged ones with nothing but a warning.
    const int compression = field<std::uint16_t>(TIFFTAG_COMPRESSION);
    if (compression == COMPRESSION_JPEG || compression == COMPRESSION_OJPEG)
      fail("is compressed as JPEG, which changes the numbers; save it without loss");
    if (const int turned = field<std::uint16_t>(TIFFTAG_ORIENTATION); turned != ORIENTATION_TOPLEFT)
      fail("is stored rotated or mirrored (Orientation " + std::to_string(turned) + "); save it upright");
    out.bits = field<std::uint16_t>(TIFFTAG_BITSPERSAMPLE);
    const int format = field<std::uint16_t>(TIFFTAG_SAMPLEFORMAT);
    out.is_float = format == SAMPLEFORMAT_IEEEFP;
    out.is_signed = format == SAMPLEFORMAT_INT;
    const bool whole = (format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_INT) &&
                       (out.bits == 8 || out.bits == 16 || out.bits == 32);
    if (!whole && !(out.is_float && (out.bits == 32 || out.bits == 64)))
      fail("has numbers of " + std::to_string(out.bits) + " bits and kind " + std::to_string(format) +
           " (SampleFormat); whole ones of 8, 16 or 32 and floats of 32 or 64 bits are read");
    const std::uint64_t needed = std::uint64_t{out.columns} * out.rows * static_cast<unsigned>(out.bits / 8);
    if (needed / kMostBytesOfOne > source_.bytes.size())
      fail("is cut off: " + std::to_string(needed) + " bytes of pixels do not fit");
  }

  // `count` stored numbers, in the byte order of this machine, as libtiff gives them.
  void numbers(const TiffImage& image, const unsigned char* from, std::size_t count, double* to) const {
    const auto all = [&](auto zero) {
      using Number = decltype(zero);
      for (std::size_t i = 0; i < count; ++i) {
        Number value;
        std::memcpy(&value, from + i * sizeof(Number), sizeof(Number));
        to[i] = static_cast<double>(value);
      }
    };
    if (image.is_float) return image.bits == 32 ? all(float{}) : all(double{});
    if (image.bits == 8) return image.is_signed ? all(std::int8_t{}) : all(std::uint8_t{});
    if (image.bits == 16) return image.is_signed ? all(std::int16_t{}) : all(std::uint16_t{});
    return image.is_signed ? all(std::int32_t{}) : all(std::uint32_t{});
  }

  void lines(TiffImage& out) {
    const tmsize_t size = TIFFScanlineSize(tiff_.get());
    const std::size_t needed = out.columns * static_cast<std::size_t>(out.bits / 8);
    if (size < 0 || static_cast<std::size_t>(size) < needed) broken();
    std::vector<unsigned char> line(static_cast<std::size_t>(size));
    for (std::size_t row = 0; row < out.rows; ++row) {
      if (TIFFReadScanline(tiff_.get(), line.data(), static_cast<std::uint32_t>(row), 0) < 0) broken();
      numbers(out, line.data(), out.columns, out.values.data() + row * out.columns);
    }
  }

  void tiles(TiffImage& out) {
    const std::size_t width = field<std::uint32_t>(TIFFTAG_TILEWIDTH);
    const std::size_t height = field<std::uint32_t>(TIFFTAG_TILELENGTH);
    const tmsize_t size = TIFFTileSize(tiff_.get());
    const auto bytes = static_cast<std::size_t>(out.bits / 8);
    if (width == 0 || height == 0 || size <= 0 || size > kMostAtOnce_bytes ||
        static_cast<std::size_t>(size) / bytes / width < height)
      broken();
    std::vector<unsigned char> tile(static_cast<std::size_t>(size));
    for (std::size_t row = 0; row < out.rows; row += height) {
      for (std::size_t column = 0; column < out.columns; column += width) {
        if (TIFFReadTile(tiff_.get(), tile.data(), static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row),
                         0, 0) < 0)
          broken();
        const std::size_t wide = std::min(width, out.columns - column);
        for (std::size_t r = 0; r < std::min(height, out.rows - row); ++r)
          numbers(out, tile.data() + r * width * bytes, wide, out.values.data() + (row + r) * out.columns + column);
      }
    }
  }

  const std::string& name_;
  Source source_;
  std::unique_ptr<TIFF, Close> tiff_;
};

TiffImage parse(std::string_view bytes, const std::string& name) { return Reader(bytes, name).read(); }

}  // namespace

}  // namespace asperity

extern "C" __attribute__((visibility("default"))) const asperity::TiffLibrary* asperity_tiff() {
  static const asperity::TiffLibrary table{asperity::kVersion, __VERSION__, asperity::parse};
  return &table;
}
