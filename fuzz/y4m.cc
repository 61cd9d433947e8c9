#include "asperity/image/y4m.h"
#include "asperity/base/error.h"
#include "fuzz_input.h"

using namespace asperity;

// The input's first line is a header, its second an image's line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz_text(data, size);
  const auto newline = text.find('\n');
  try {
    const Y4mHeader header = parse_y4m_header(text.substr(0, newline), "in");
    must(header.width >= 1 && header.width <= kLargestImageSide_px);
    must(header.height >= 1 && header.height <= kLargestImageSide_px);
    must(header.rate_numerator >= 0 && header.rate_denominator > 0);
    must(header.chroma_bytes() <= 3 * header.luma_bytes());
    std::string again = format_y4m_header(header);
    again.pop_back();
    must(parse_y4m_header(again, "again").chroma_bytes() == header.chroma_bytes());
    if (newline != std::string_view::npos) parse_y4m_frame_line(text.substr(newline + 1), "in");
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("in: "));
  }
  return 0;
}
