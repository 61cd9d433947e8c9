#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "asperity/image/gray_image.h"

namespace asperity {

// YUV4MPEG2, the plain stream of images that ffmpeg and mjpegtools pass through pipes: a header line, then for each
// image a line and its planes, of which we use the luma. Of ours is one parameter of an image's line: `Xt_ns=N`,
// the time of its exposure on the host's monotonic clock, ns (parameters that begin with X are an application's own).
//
//   YUV4MPEG2 W640 H480 F120:1 Ip A1:1 Cmono\n
//   FRAME Xt_ns=1200000000\n
//   640·480 bytes, row by row from the top

inline constexpr std::size_t kLongestY4mLine = 1024;  // bytes, its newline apart

struct Y4mHeader {
  int width = 0;
  int height = 0;
  std::int64_t rate_numerator = 0;  // images in rate_denominator seconds; 0 where the stream does not say
  std::int64_t rate_denominator = 1;
  std::string chroma = "mono";  // mono, 420, 420jpeg, 420mpeg2, 420paldv, 411, 422, 444, 444alpha

  std::size_t luma_bytes() const;
  std::size_t chroma_bytes() const;  // behind the luma, passed over
};

// The first line, without its newline. Throws Error, its message beginning with `name`, if it is not YUV4MPEG2, lacks
// a size, or is of a kind we cannot use: a side outside 1…kLargestImageSide_px, interlaced, more than 8 bits.
Y4mHeader parse_y4m_header(std::string_view line, const std::string& name);

// An image's line, without its newline: its Xt_ns, nullopt if it has none. Throws Error as above.
std::optional<std::int64_t> parse_y4m_frame_line(std::string_view line, const std::string& name);

// The first line with its newline. Throws Error for a header that parse_y4m_header would refuse.
std::string format_y4m_header(const Y4mHeader& header);

// Appends an image of a stream whose chroma is "mono". Throws Error if its size is not the header's.
void append_y4m_frame(std::string& out, const Y4mHeader& header, const GrayImage& image,
                      std::optional<std::int64_t> t_ns);

}  // namespace asperity
