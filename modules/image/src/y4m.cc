#include "asperity/image/y4m.h"

#include <array>
#include <charconv>
#include <limits>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::string_view kMagic = "YUV4MPEG2";
constexpr std::string_view kFrame = "FRAME";
constexpr std::string_view kTime = "Xt_ns=";
constexpr std::int64_t kLargestRatePart = 1'000'000'000;

constexpr std::array<std::string_view, 9> kChroma = {"mono", "420", "420jpeg", "420mpeg2", "420paldv",
                                                     "411",  "422", "444",     "444alpha"};

// Whole and positive numbers only; "+5", "5x" and "" are none.
template <class Integer>
std::optional<Integer> whole(std::string_view text) {
  Integer value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Takes the next parameter off `rest`; empty at the end.
std::string_view next_parameter(std::string_view& rest) {
  const auto begin = rest.find_first_not_of(' ');
  if (begin == std::string_view::npos) return rest = {};
  const auto end = rest.find(' ', begin);
  const std::string_view out = rest.substr(begin, end - begin);
  rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end);
  return out;
}

int parse_side(std::string_view text, char which, const std::string& name) {
  const auto side = whole<int>(text);
  if (!side || *side < 1 || *side > kLargestImageSide_px) {
    throw Error(name + ": the size " + which + printable(text) + " is not within 1 to " +
                std::to_string(kLargestImageSide_px) + " pixels");
  }
  return *side;
}

void parse_rate(std::string_view text, Y4mHeader& out, const std::string& name) {
  const auto colon = text.find(':');
  const auto numerator = whole<std::int64_t>(text.substr(0, colon));
  const auto denominator = colon == std::string_view::npos ? std::nullopt : whole<std::int64_t>(text.substr(colon + 1));
  if (!numerator || !denominator || *numerator < 0 || *numerator > kLargestRatePart || *denominator < 0 ||
      *denominator > kLargestRatePart) {
    throw Error(name + ": the rate F" + printable(text) + " is not two numbers with a colon between");
  }
  const bool known = *numerator > 0 && *denominator > 0;
  out.rate_numerator = known ? *numerator : 0;
  out.rate_denominator = known ? *denominator : 1;
}

void parse_chroma(std::string_view text, Y4mHeader& out, const std::string& name) {
  for (const std::string_view known : kChroma) {
    if (text == known) {
      out.chroma = known;
      return;
    }
  }
  throw Error(name + ": images of the kind C" + printable(text) +
              " cannot be read, only 8-bit mono, 420, 411, 422 and 444");
}

std::size_t half(int side) { return static_cast<std::size_t>(side + 1) / 2; }

}  // namespace

std::size_t Y4mHeader::luma_bytes() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

std::size_t Y4mHeader::chroma_bytes() const {
  if (chroma == "mono") return 0;
  if (chroma == "411") return 2 * (static_cast<std::size_t>(width + 3) / 4) * static_cast<std::size_t>(height);
  if (chroma == "422") return 2 * half(width) * static_cast<std::size_t>(height);
  if (chroma == "444") return 2 * luma_bytes();
  if (chroma == "444alpha") return 3 * luma_bytes();
  return 2 * half(width) * half(height);
}

Y4mHeader parse_y4m_header(std::string_view line, const std::string& name) {
  std::string_view rest = line;
  if (next_parameter(rest) != kMagic) {
    throw Error(name + ": is not a YUV4MPEG2 stream: it begins with '" + printable(line, 20) + "'");
  }
  Y4mHeader out;
  out.chroma = "420";
  for (std::string_view parameter = next_parameter(rest); !parameter.empty(); parameter = next_parameter(rest)) {
    const std::string_view value = parameter.substr(1);
    switch (parameter.front()) {
      case 'W':
        out.width = parse_side(value, 'W', name);
        break;
      case 'H':
        out.height = parse_side(value, 'H', name);
        break;
      case 'F':
        parse_rate(value, out, name);
        break;
      case 'C':
        parse_chroma(value, out, name);
        break;
      case 'I':
        if (value != "p" && value != "?") {
          throw Error(name + ": its images are interlaced (I" + printable(value) +
                      "): their halves are of different times");
        }
        break;
      case 'A':
      case 'X':
        break;
      default:
        throw Error(name + ": unknown parameter '" + printable(parameter) + "'");
    }
  }
  if (out.width == 0 || out.height == 0) throw Error(name + ": the header gives no size (W and H)");
  return out;
}

std::optional<std::int64_t> parse_y4m_frame_line(std::string_view line, const std::string& name) {
  std::string_view rest = line;
  if (next_parameter(rest) != kFrame) {
    throw Error(name + ": expected FRAME, found '" + printable(line, 20) + "'");
  }
  std::optional<std::int64_t> t_ns;
  for (std::string_view parameter = next_parameter(rest); !parameter.empty(); parameter = next_parameter(rest)) {
    if (!parameter.starts_with(kTime)) continue;
    t_ns = whole<std::int64_t>(parameter.substr(kTime.size()));
    if (!t_ns) throw Error(name + ": '" + printable(parameter) + "' is not a whole number of nanoseconds");
  }
  return t_ns;
}

std::string format_y4m_header(const Y4mHeader& header) {
  const std::string line = std::string(kMagic) + " W" + std::to_string(header.width) + " H" +
                           std::to_string(header.height) + " F" + std::to_string(header.rate_numerator) + ":" +
                           std::to_string(header.rate_denominator) + " Ip A1:1 C" + header.chroma;
  parse_y4m_header(line, "y4m");
  return line + "\n";
}

void append_y4m_frame(std::string& out, const Y4mHeader& header, const GrayImage& image,
                      std::optional<std::int64_t> t_ns) {
  if (header.chroma != "mono") throw Error("y4m: only mono images are written, not " + printable(header.chroma));
  if (image.width != header.width || image.height != header.height || image.pixels.size() != header.luma_bytes()) {
    throw Error("y4m: an image of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                " in a stream of " + std::to_string(header.width) + " x " + std::to_string(header.height));
  }
  out += kFrame;
  if (t_ns) out += " " + std::string(kTime) + std::to_string(*t_ns);
  out += '\n';
  out.append(image.pixels.begin(), image.pixels.end());
}

}  // namespace asperity
