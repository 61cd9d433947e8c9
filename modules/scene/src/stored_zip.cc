#include "stored_zip.h"

#include <array>
#include <cstdint>

#include "asperity/base/error.h"
#include "little_endian.h"

namespace asperity {
namespace {

std::uint32_t crc32(const std::string& data) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t;
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t c = i;
      for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
      t[i] = c;
    }
    return t;
  }();
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char byte : data) crc = table[(crc ^ static_cast<unsigned char>(byte)) & 0xFF] ^ (crc >> 8);
  return ~crc;
}

// What a member's header and its entry in the directory have in common.
void append_description(std::string& out, const ZipMember& member) {
  constexpr std::uint32_t kVersion = 20;
  constexpr std::uint32_t kFirstDay = 1 << 5 | 1;  // 1980-01-01
  append_little_endian(out, kVersion, 2);
  append_little_endian(out, 0, 2);  // flags
  append_little_endian(out, 0, 2);  // stored
  append_little_endian(out, 0, 2);  // midnight
  append_little_endian(out, kFirstDay, 2);
  append_little_endian(out, crc32(member.content), 4);
  append_little_endian(out, member.content.size(), 4);
  append_little_endian(out, member.content.size(), 4);
  append_little_endian(out, member.name.size(), 2);
  append_little_endian(out, 0, 2);  // extra fields
}

}  // namespace

std::string format_stored_zip(const std::vector<ZipMember>& members) {
  std::string out;
  std::string directory;
  for (const ZipMember& member : members) {
    if (out.size() + member.content.size() > 0xFFFF0000u) throw Error("zip: more than 4 GiB");
    const std::size_t offset = out.size();
    out += "PK\x03\x04";
    append_description(out, member);
    out += member.name + member.content;
    directory += "PK\x01\x02";
    append_little_endian(directory, 20, 2);  // made by
    append_description(directory, member);
    append_little_endian(directory, 0, 2);  // comment
    append_little_endian(directory, 0, 2);  // disk
    append_little_endian(directory, 0, 2);  // attributes
    append_little_endian(directory, 0, 4);
    append_little_endian(directory, offset, 4);
    directory += member.name;
  }
  const std::size_t offset = out.size();
  out += directory + "PK\x05\x06";
  append_little_endian(out, 0, 4);  // disks
  append_little_endian(out, members.size(), 2);
  append_little_endian(out, members.size(), 2);
  append_little_endian(out, directory.size(), 4);
  append_little_endian(out, offset, 4);
  append_little_endian(out, 0, 2);
  return out;
}

}  // namespace asperity
