#include "asperity/session/our_file.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>

#include "asperity/base/crc32.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBegin_bytes = 4096;
constexpr std::size_t kPngHeader_bytes = 8 + 25;  // the signature and IHDR

std::string big_endian(std::uint32_t value) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>((value >> shift) & 0xffU);
  return out;
}

std::string png_note() {
  using namespace std::string_view_literals;
  const std::string text{"tEXtSoftware\0asperity"sv};
  return big_endian(static_cast<std::uint32_t>(text.size() - 4)) + text + big_endian(crc32(text));
}

}  // namespace

void refuse_stranger(const fs::path& file, const IsOurs& is_ours, const std::vector<std::string>& inputs) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(file, ignored);
  if (!fs::exists(status)) return;
  const auto refuse = [&](const char* why) {
    throw Error(printable(file.string(), 200) + ": exists and " + why + "; nothing was changed");
  };
  if (!fs::is_regular_file(status)) refuse("is not a regular file");
  for (const std::string& input : inputs) {
    if (fs::equivalent(file, input, ignored)) refuse("is read by this command");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse("cannot be read");
  std::string begin(kBegin_bytes, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(in.gcount()));
  if (!begin.empty() && !is_ours(begin)) refuse("was not written by this command");
}

void refuse_stranger(const fs::path& file, std::string_view header, const std::vector<std::string>& inputs) {
  refuse_stranger(
      file, [header](std::string_view begin) { return begin.starts_with(header); }, inputs);
}

namespace {

bool begins_as_format(std::string_view begin, std::string_view format) {
  std::string dense;
  std::copy_if(begin.begin(), begin.end(), std::back_inserter(dense),
               [](char c) { return c != ' ' && c != '\n' && c != '\r' && c != '\t'; });
  return dense.starts_with(R"({"format":")" + std::string(format) + R"(",)");
}

}  // namespace

bool begins_as_texture(std::string_view begin) { return begins_as_format(begin, "asperity-texture"); }

bool begins_as_scene(std::string_view begin) { return begins_as_format(begin, "asperity-scene"); }

std::string signed_png(std::string png) {
  png.insert(kPngHeader_bytes, png_note());
  return png;
}

bool begins_as_signed_png(std::string_view begin) {
  return begin.size() > kPngHeader_bytes && begin.substr(kPngHeader_bytes).starts_with(png_note());
}

}  // namespace asperity
