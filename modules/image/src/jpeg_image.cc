#include "asperity/image/jpeg_image.h"

#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstring>

#include <jpeglib.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

constexpr long kMostMemory_bytes = 512L << 20;
constexpr int kMostScans = 500;  // a progressive image of few bytes could ask for millions of passes over its pixels

// libjpeg reports errors by a function that must not return; the text is kept for the Error.
struct JpegFault {
  jpeg_error_mgr manager{};  // libjpeg's part: first, so that its address is the fault's
  std::jmp_buf back{};
  char text[JMSG_LENGTH_MAX] = "";
};

[[noreturn]] void on_jpeg_error(j_common_ptr jpeg) {
  auto* fault = reinterpret_cast<JpegFault*>(jpeg->err);
  (*jpeg->err->format_message)(jpeg, fault->text);
  std::longjmp(fault->back, 1);
}

void on_jpeg_warning(j_common_ptr, int) {}
void on_jpeg_message(j_common_ptr) {}

void bound_scans(j_common_ptr jpeg) {
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMostScans) return;
  auto* fault = reinterpret_cast<JpegFault*>(jpeg->err);
  std::strcpy(fault->text, "too many scans");
  std::longjmp(fault->back, 1);
}

class JpegReader {
 public:
  JpegReader() {
    jpeg_.err = jpeg_std_error(&fault_.manager);
    fault_.manager.error_exit = on_jpeg_error;
    fault_.manager.emit_message = on_jpeg_warning;
    fault_.manager.output_message = on_jpeg_message;
    progress_.progress_monitor = bound_scans;
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  // Nothing that has a destructor is made between setjmp and the calls that may jump.
  bool begin(const unsigned char* data, std::size_t size) {
    if (setjmp(fault_.back) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_.progress = &progress_;
    jpeg_.mem->max_memory_to_use = kMostMemory_bytes;
    jpeg_mem_src(&jpeg_, data, static_cast<unsigned long>(size));
    jpeg_read_header(&jpeg_, TRUE);
    return true;
  }

  bool read_rows(JSAMPLE* pixels) {
    if (setjmp(fault_.back) != 0) return false;
    jpeg_.out_color_space = JCS_GRAYSCALE;
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = pixels + static_cast<std::size_t>(jpeg_.output_scanline) * jpeg_.output_width;
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

  unsigned width() const { return jpeg_.image_width; }
  unsigned height() const { return jpeg_.image_height; }
  int colours() const { return jpeg_.num_components; }
  std::string fault() const { return printable(fault_.text, 200); }

 private:
  JpegFault fault_;
  jpeg_progress_mgr progress_{};
  jpeg_decompress_struct jpeg_{};
};

}  // namespace

GrayImage decode_jpeg(std::span<const unsigned char> bytes, const std::string& name) {
  const auto damaged = [&name](const JpegReader& reader) {
    throw Error(name + ": the image is damaged: " + reader.fault());
  };
  JpegReader reader;
  if (!reader.begin(bytes.data(), bytes.size())) damaged(reader);
  if (reader.colours() == 4) throw Error(name + ": a JPEG image of four colours (CMYK) cannot be read");
  constexpr auto kMost = static_cast<unsigned>(kLargestImageSide_px);
  if (reader.width() < 1 || reader.height() < 1 || reader.width() > kMost || reader.height() > kMost) {
    throw Error(name + ": the image has " + std::to_string(reader.width()) + " x " + std::to_string(reader.height()) +
                " pixels, not 1 to " + std::to_string(kMost) + " a side");
  }
  GrayImage out;
  out.width = static_cast<int>(reader.width());
  out.height = static_cast<int>(reader.height());
  out.pixels.resize(static_cast<std::size_t>(reader.width()) * reader.height());
  if (!reader.read_rows(out.pixels.data())) damaged(reader);
  return out;
}

}  // namespace asperity
