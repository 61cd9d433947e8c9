#include "asperity/image/read_gray_image.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/image/jpeg_image.h"
#include "asperity/image/pgm_image.h"
#include "asperity/image/png_image.h"

namespace asperity {

namespace {

using Bytes = std::span<const unsigned char>;
using Size = std::pair<std::int64_t, std::int64_t>;

constexpr std::uint64_t kLargestFile_bytes = std::uint64_t{256} << 20;
constexpr std::array<unsigned char, 8> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

bool starts_with(Bytes bytes, Bytes magic) {
  return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

std::int64_t big_endian(Bytes bytes) {
  std::int64_t out = 0;
  for (const unsigned char byte : bytes) out = out << 8 | byte;
  return out;
}

std::optional<Size> png_size(Bytes bytes) {
  constexpr std::array<unsigned char, 4> kHeader = {'I', 'H', 'D', 'R'};
  if (bytes.size() < 24 || !starts_with(bytes.subspan(12), kHeader)) return std::nullopt;
  const Size size{big_endian(bytes.subspan(16, 4)), big_endian(bytes.subspan(20, 4))};
  // Chunk after chunk to the last: libpng would tell standard error that a file is cut off.
  for (std::size_t at = kPng.size(); at + 12 <= bytes.size();) {
    constexpr std::array<unsigned char, 4> kEnd = {'I', 'E', 'N', 'D'};
    if (starts_with(bytes.subspan(at + 4), kEnd)) return size;
    at += 12 + static_cast<std::size_t>(big_endian(bytes.subspan(at, 4)));
  }
  return std::nullopt;
}

// From the first frame header (SOF0…SOF15) behind the segments before it.
std::optional<Size> jpeg_size(Bytes bytes) {
  std::size_t at = 2;
  while (at + 9 <= bytes.size()) {
    if (bytes[at] != 0xff) return std::nullopt;
    const unsigned char marker = bytes[at + 1];
    if (marker == 0xff) {
      ++at;
      continue;
    }
    if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc) {
      return Size{big_endian(bytes.subspan(at + 7, 2)), big_endian(bytes.subspan(at + 5, 2))};
    }
    const auto length = static_cast<std::size_t>(big_endian(bytes.subspan(at + 2, 2)));
    if (length < 2) return std::nullopt;
    at += 2 + length;
  }
  return std::nullopt;
}

// A number of a PNM header, behind blanks and comments.
std::optional<std::int64_t> pnm_number(Bytes bytes, std::size_t& at) {
  const auto is_blank = [](unsigned char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
  while (at < bytes.size() && (is_blank(bytes[at]) || bytes[at] == '#')) {
    if (bytes[at] == '#') {
      while (at < bytes.size() && bytes[at] != '\n') ++at;
    } else {
      ++at;
    }
  }
  std::int64_t out = 0;
  const std::size_t begin = at;
  while (at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9' && at - begin < 9)
    out = 10 * out + (bytes[at++] - '0');
  return at == begin ? std::nullopt : std::optional(out);
}

std::optional<Size> pnm_size(Bytes bytes) {
  std::size_t at = 2;
  const auto width = pnm_number(bytes, at);
  const auto height = pnm_number(bytes, at);
  const auto white = pnm_number(bytes, at);
  if (!width || !height || !white || *white < 1 || *white > 65535) return std::nullopt;
  // A file that is cut off would be decoded with what memory held before.
  const std::int64_t samples = *width * *height * (bytes[1] == '6' ? 3 : 1);
  const std::int64_t needed = samples * (*white > 255 ? 2 : 1);
  if (static_cast<std::int64_t>(bytes.size() - at) < needed + 1) return std::nullopt;
  return Size{*width, *height};
}

// libjpeg fills up what is missing with gray and only warns, as it does of many a camera's frames.
bool jpeg_is_whole(Bytes bytes) {
  std::size_t end = bytes.size();
  while (end > 0 && bytes[end - 1] == 0) --end;
  return end >= 4 && bytes[end - 2] == 0xff && bytes[end - 1] == 0xd9;
}

bool is_jpeg(Bytes bytes) { return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff; }
bool is_pnm(Bytes bytes) { return bytes.size() >= 3 && bytes[0] == 'P' && (bytes[1] == '5' || bytes[1] == '6'); }

}  // namespace

std::pair<int, int> encoded_image_size(Bytes bytes, const std::string& name) {
  std::optional<Size> size;
  if (starts_with(bytes, kPng)) {
    size = png_size(bytes);
  } else if (is_jpeg(bytes)) {
    size = jpeg_size(bytes);
  } else if (is_pnm(bytes)) {
    size = pnm_size(bytes);
  } else {
    throw Error(name + ": is not an image that can be read (PNG, JPEG, binary PGM or PPM)");
  }
  if (!size || size->first < 1 || size->second < 1) throw Error(name + ": the image is damaged");
  if (size->first > kLargestImageSide_px || size->second > kLargestImageSide_px) {
    throw Error(name + ": the image has " + std::to_string(size->first) + " x " + std::to_string(size->second) +
                " pixels, more than " + std::to_string(kLargestImageSide_px) + " a side");
  }
  return {static_cast<int>(size->first), static_cast<int>(size->second)};
}

GrayImage decode_gray_image(Bytes bytes, const std::string& name) {
  const auto [width, height] = encoded_image_size(bytes, name);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  GrayImage out;
  if (is_jpeg(bytes)) {
    if (!jpeg_is_whole(bytes)) throw Error(name + ": the image is damaged: it is cut off");
    out = decode_jpeg(bytes, name);
  } else {
    out = is_pnm(bytes) ? decode_pnm(text, name) : decode_png(text, name);
  }
  if (out.width != width || out.height != height) throw Error(name + ": the image is damaged");
  return out;
}

GrayImage read_gray_image(const std::filesystem::path& path) {
  const std::string content = read_file(path, kLargestFile_bytes);
  return decode_gray_image({reinterpret_cast<const unsigned char*>(content.data()), content.size()}, path.string());
}

}  // namespace asperity
