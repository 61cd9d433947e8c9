#include "asperity/image/pgm_image.h"

#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr auto kMostSide = static_cast<std::size_t>(kLargestImageSide_px);

class PnmReader {
 public:
  PnmReader(std::string_view data, const std::string& name) : data_(data), name_(name) {}

  [[noreturn]] void fail(const std::string& what) const { throw Error(name_ + ": a PGM image that " + what); }

  bool at_end() const { return at_ == data_.size(); }
  std::size_t left() const { return data_.size() - at_; }

  // A comment reaches from # to the end of its line.
  void skip_blanks() {
    while (!at_end()) {
      if (data_[at_] == '#') {
        while (!at_end() && data_[at_] != '\n') ++at_;
      } else if (std::isspace(static_cast<unsigned char>(data_[at_])) != 0) {
        ++at_;
      } else {
        return;
      }
    }
  }

  std::size_t number(const char* what, std::size_t most) {
    skip_blanks();
    std::size_t value = 0;
    const std::size_t first = at_;
    while (!at_end() && data_[at_] >= '0' && data_[at_] <= '9') {
      value = 10 * value + static_cast<std::size_t>(data_[at_++] - '0');
      if (value > most) fail(std::string("has a ") + what + " above " + std::to_string(most));
    }
    if (at_ == first) fail(std::string("has no ") + what);
    return value;
  }

  std::size_t byte() { return static_cast<unsigned char>(data_[at_++]); }
  void skip(std::size_t count) { at_ += count; }

 private:
  std::string_view data_;
  const std::string& name_;
  std::size_t at_ = 0;
};

}  // namespace

DeepGrayImage parse_pgm(std::string_view data, const std::string& name) {
  PnmReader in(data, name);
  if (data.size() < 2 || data[0] != 'P' || (data[1] != '5' && data[1] != '2')) in.fail("does not begin with P5 or P2");
  const bool binary = data[1] == '5';
  in.skip(2);
  DeepGrayImage image;
  image.width = static_cast<int>(in.number("width", kMostSide));
  image.height = static_cast<int>(in.number("height", kMostSide));
  const std::size_t most = in.number("maximum", 65535);
  if (image.width == 0 || image.height == 0 || most == 0) in.fail("is empty");
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const std::size_t bytes = most > 255 ? 2 : 1;
  if (binary) {
    if (in.at_end() || std::isspace(static_cast<int>(in.byte())) == 0) in.fail("has no blank before its pixels");
    if (in.left() != pixels * bytes) {
      in.fail("has " + std::to_string(in.left()) + " bytes of pixels where " + std::to_string(pixels * bytes) +
              " are due");
    }
  } else if (in.left() < 2 * pixels - 1) {
    in.fail("is cut off");
  }
  image.bits = bytes == 1 ? 8 : 16;
  const std::size_t full = bytes == 1 ? 255 : 65535;
  image.pixels.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    std::size_t level = 0;
    if (binary) {
      level = in.byte();
      if (bytes == 2) level = 256 * level + in.byte();
      if (level > most) in.fail("has a level above its maximum");
    } else {
      level = in.number("level", most);
    }
    image.pixels.push_back(static_cast<std::uint16_t>((level * full + most / 2) / most));
  }
  if (!binary) {
    in.skip_blanks();
    if (!in.at_end()) in.fail("has data after its last pixel");
  }
  return image;
}

GrayImage decode_pnm(std::string_view data, const std::string& name) {
  PnmReader in(data, name);
  if (data.size() < 2 || data[0] != 'P' || (data[1] != '5' && data[1] != '6')) in.fail("does not begin with P5 or P6");
  const std::size_t colours = data[1] == '6' ? 3 : 1;
  in.skip(2);
  GrayImage image;
  image.width = static_cast<int>(in.number("width", kMostSide));
  image.height = static_cast<int>(in.number("height", kMostSide));
  const std::size_t most = in.number("maximum", 65535);
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (pixels == 0 || most == 0) in.fail("is empty");
  const std::size_t bytes = most > 255 ? 2 : 1;  // of a sample, the upper first
  if (in.left() < 1 + pixels * colours * bytes) in.fail("is cut off");
  in.skip(1);
  image.pixels.reserve(pixels);
  std::array<std::size_t, 3> level{};
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < colours; ++c) {
      level[c] = in.byte();
      in.skip(bytes - 1);
    }
    // The weights of ITU-R BT.601 in 14 bits.
    if (colours == 3) level[0] = (4899 * level[0] + 9617 * level[1] + 1868 * level[2] + 8192) >> 14;
    image.pixels.push_back(static_cast<std::uint8_t>(level[0]));
  }
  return image;
}

}  // namespace asperity
